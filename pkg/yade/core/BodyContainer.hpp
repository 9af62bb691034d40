// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Body.hpp>
#include <mutex>

namespace yade {

class BodyContainer : public Serializable {
	YADE_DECLARED_CLASS(BodyContainer)

	using ContainerT = std::vector<shared_ptr<Body>>;

	/* begin() and end() return 24 bytes: where one is, eight bytes that stay unset, and the end of the vector. An erased body
	leaves an empty pointer, which iteration skips. */
	class LiveIterator {
	public:
		shared_ptr<Body>& operator*() const { return *at; }
		shared_ptr<Body>* operator->() const { return &*at; }
		LiveIterator&     operator++()
		{
			do
				++at;
			while (at != last && !*at);
			return *this;
		}
		bool operator==(const LiveIterator& other) const { return at == other.at; }
		bool operator!=(const LiveIterator& other) const { return at != other.at; }

	private:
		ContainerT::iterator at, unset, last;
	};

	Body::id_t              insert(shared_ptr<Body> body);
	bool                    erase(Body::id_t id, bool eraseClumpMembers);
	void                    clear();
	bool                    exists(Body::id_t id) const;
	std::size_t             size() const;
	shared_ptr<Body>&       operator[](unsigned int id);
	const shared_ptr<Body>& operator[](unsigned int id) const;
	LiveIterator            begin();
	LiveIterator            end();

	ContainerT              body;
	bool                    dirty;
	bool                    checkedByCollider;
	std::vector<Body::id_t> insertedBodies;
	std::vector<Body::id_t> erasedBodies;
	std::vector<Body::id_t> realBodies;
	bool                    useRedirection;
	bool                    enableRedirection;
	std::vector<Body::id_t> subdomainBodies;
	std::mutex              drawloopmutex;

protected:
	BodyContainer();
};
YADE_LAYOUT_SIZE(BodyContainer, 200)
YADE_LAYOUT_SIZE(BodyContainer::LiveIterator, 24)
YADE_LAYOUT_OFFSET(BodyContainer, body, 24)
YADE_LAYOUT_OFFSET(BodyContainer, dirty, 48)
YADE_LAYOUT_OFFSET(BodyContainer, checkedByCollider, 49)
YADE_LAYOUT_OFFSET(BodyContainer, insertedBodies, 56)
YADE_LAYOUT_OFFSET(BodyContainer, erasedBodies, 80)
YADE_LAYOUT_OFFSET(BodyContainer, useRedirection, 128)
YADE_LAYOUT_OFFSET(BodyContainer, drawloopmutex, 160)

} // namespace yade
