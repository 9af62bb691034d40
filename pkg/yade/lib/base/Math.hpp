// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/enable_shared_from_this.hpp>
#include <boost/make_shared.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/shared_ptr.hpp>
#include <boost/weak_ptr.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#ifndef EIGEN_DONT_ALIGN
#	error "YADE 2023.02a needs EIGEN_DONT_ALIGN in every translation unit (link the CMake target yade::declarations)"
#endif

namespace yade {

using Real        = double;
using Vector2r    = Eigen::Matrix<Real, 2, 1>;
using Vector3r    = Eigen::Matrix<Real, 3, 1>;
using Vector6r    = Eigen::Matrix<Real, 6, 1>;
using Vector2i    = Eigen::Matrix<int, 2, 1>;
using Vector3i    = Eigen::Matrix<int, 3, 1>;
using Matrix3r    = Eigen::Matrix<Real, 3, 3>;
using Quaternionr = Eigen::Quaternion<Real>;
using AngleAxisr  = Eigen::AngleAxis<Real>;

using boost::dynamic_pointer_cast;
using boost::enable_shared_from_this;
using boost::make_shared;
using boost::shared_ptr;
using boost::static_pointer_cast;
using boost::weak_ptr;
using std::string;
using std::vector;

constexpr Real NaN = std::numeric_limits<Real>::quiet_NaN();

struct Mathr {
	static constexpr Real PI       = 3.14159265358979323846;
	static constexpr Real TWO_PI   = 2 * PI;
	static constexpr Real HALF_PI  = PI / 2;
	static constexpr Real MAX_REAL = std::numeric_limits<Real>::max();
	static constexpr Real EPSILON  = std::numeric_limits<Real>::epsilon();
};

} // namespace yade

/* The archives name the components of a vector x, y, z and those of a matrix m00 .. m22. These templates have the same
signatures as the library's, which may replace them at load time: what they write must stay the same. */
namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, yade::Vector2r& v, const unsigned int) { ar& make_nvp("x", v[0]) & make_nvp("y", v[1]); }
	template <class Archive> void serialize(Archive& ar, yade::Vector2i& v, const unsigned int) { ar& make_nvp("x", v[0]) & make_nvp("y", v[1]); }
	template <class Archive> void serialize(Archive& ar, yade::Vector3r& v, const unsigned int)
	{
		ar& make_nvp("x", v[0]) & make_nvp("y", v[1]) & make_nvp("z", v[2]);
	}
	template <class Archive> void serialize(Archive& ar, yade::Vector3i& v, const unsigned int)
	{
		ar& make_nvp("x", v[0]) & make_nvp("y", v[1]) & make_nvp("z", v[2]);
	}
	template <class Archive> void serialize(Archive& ar, yade::Quaternionr& q, const unsigned int)
	{
		ar& make_nvp("w", q.w()) & make_nvp("x", q.x()) & make_nvp("y", q.y()) & make_nvp("z", q.z());
	}
	template <class Archive> void serialize(Archive& ar, yade::Matrix3r& m, const unsigned int)
	{
		ar& make_nvp("m00", m(0, 0)) & make_nvp("m01", m(0, 1)) & make_nvp("m02", m(0, 2));
		ar& make_nvp("m10", m(1, 0)) & make_nvp("m11", m(1, 1)) & make_nvp("m12", m(1, 2));
		ar& make_nvp("m20", m(2, 0)) & make_nvp("m21", m(2, 1)) & make_nvp("m22", m(2, 2));
	}
} // namespace serialization
} // namespace boost
