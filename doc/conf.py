# SPDX-License-Identifier: GPL-2.0-or-later
# Configuration of the manual; scripts/doc gathers its pages and runs Sphinx.
project = 'yade-mpm'
author = 'the authors of yade-mpm'
extensions = ['myst_parser']
myst_heading_anchors = 3
html_theme = 'classic'  # YADE's own manual looks like this
html_theme_options = {'sidebarwidth': 260, 'body_max_width': 1000}
html_title = 'yade-mpm'
html_static_path = ['static']
html_css_files = ['manual.css']
toc_object_entries_show_parents = 'hide'  # the sidebar names an attribute without its class
smartquotes = False  # --points stays two hyphens
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
add_module_names = False
primary_domain = 'py'
highlight_language = 'python'
suppress_warnings = ['misc.highlighting_failure']  # indented formulae are not Python
