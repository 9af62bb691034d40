// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>
#include <mutex>

namespace yade {

template <class RealType> struct Se3 {
	Eigen::Matrix<RealType, 3, 1> position    = Eigen::Matrix<RealType, 3, 1>::Zero();
	Eigen::Quaternion<RealType>   orientation = Eigen::Quaternion<RealType>::Identity();

	template <class Archive> void serialize(Archive& archive, const unsigned int)
	{
		archive& BOOST_SERIALIZATION_NVP(position) & BOOST_SERIALIZATION_NVP(orientation);
	}
};
using Se3r = Se3<Real>;
YADE_LAYOUT_SIZE(Se3r, 56)

class State : public Serializable, public Indexable {
	YADE_DECLARED_CLASS(State)
	YADE_DECLARED_INDEX()
	YADE_DECLARED_INDEX_COUNTER()
public:
	YADE_DECLARED_SERIALIZE(Serializable, (se3)(vel)(mass)(angVel)(angMom)(inertia)(refPos)(refOri)(blockedDOFs)(isDamped)(densityScaling))

	State();

	enum {
		DOF_NONE   = 0,
		DOF_X      = 1,
		DOF_Y      = 2,
		DOF_Z      = 4,
		DOF_RX     = 8,
		DOF_RY     = 16,
		DOF_RZ     = 32,
		DOF_ALL    = 63,
		DOF_XYZ    = 7,
		DOF_RXRYRZ = 56,
	};
	static unsigned axisDOF(int axis, bool rotational = false) { return 1u << (axis + (rotational ? 3 : 0)); }

	std::string blockedDOFs_vec_get() const;
	void        blockedDOFs_vec_set(const std::string& dofs);

	Vector3r&    pos; // se3.position
	Quaternionr& ori; // se3.orientation
	std::mutex   updateMutex;
	Se3r         se3;
	Vector3r     vel;
	Real         mass;
	Vector3r     angVel;
	Vector3r     angMom;
	Vector3r     inertia;
	Vector3r     refPos;
	Quaternionr  refOri;
	unsigned     blockedDOFs;
	bool         isDamped;
	Real         densityScaling;
};
YADE_LAYOUT_SIZE(State, 320)
YADE_LAYOUT_OFFSET(State, se3, 88)
YADE_LAYOUT_OFFSET(State, vel, 144)
YADE_LAYOUT_OFFSET(State, mass, 168)
YADE_LAYOUT_OFFSET(State, inertia, 224)
YADE_LAYOUT_OFFSET(State, refOri, 272)
YADE_LAYOUT_OFFSET(State, blockedDOFs, 304)
YADE_LAYOUT_OFFSET(State, isDamped, 308)
YADE_LAYOUT_OFFSET(State, densityScaling, 312)

} // namespace yade
