// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "kernel/Version.hpp"
#include <lib/serialization/Serializable.hpp>
#include <stdexcept>
#include <string>

namespace yade {

/* The first attribute of a class whose saved attributes may differ from version to version: its value in a file is the version that
has written the file. Loading reads a file of this version, patch releases included, and refuses any other. */
struct SavedBy {
	static constexpr const char* prefix = "yade-mpm ";

	static void check(const std::string& found)
	{
		const std::string here     = mpm::version();
		const auto        readable = [](const std::string& version) { return version.substr(0, version.rfind('.')); };
		const bool        known    = found.compare(0, std::string(prefix).size(), prefix) == 0;
		if (known && readable(found.substr(std::string(prefix).size())) == readable(here)) return;
		throw std::runtime_error("The scene was saved by " + (known ? found : "yade-mpm before 1.0.0") + ", and this is yade-mpm " + here
					 + ", which cannot read it: load it with that version, or run its script again");
	}
};

} // namespace yade

namespace boost::serialization {
template <class Archive> void serialize(Archive& archive, yade::SavedBy&, const unsigned int)
{
	std::string version = std::string(yade::SavedBy::prefix) + yade::mpm::version();
	if constexpr (Archive::is_saving::value)
		archive& make_nvp("version", version);
	else {
		try {
			archive& make_nvp("version", version);
		} catch (const std::exception&) { // a file from before there were versions has another attribute here
			version.clear();
		}
		yade::SavedBy::check(version);
	}
}
} // namespace boost::serialization

// no entry of its own in a file: what stands there is found out by reading it
BOOST_CLASS_IMPLEMENTATION(yade::SavedBy, object_serializable)
BOOST_CLASS_TRACKING(yade::SavedBy, track_never)
