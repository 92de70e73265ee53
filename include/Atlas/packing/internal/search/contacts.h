// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SEARCH_CONTACTS_H
#define ATLAS_PACKING_INTERNAL_SEARCH_CONTACTS_H

#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Where two shapes come too near to each other.
struct Contact
{
  Vec2 point, normal; ///< in texels; the normal points from the second shape to the first
  double depth = 0;   ///< how much of the gutter is missing
};

/// A small motion of a shape about its centre.
struct Contact_motion
{
  Vec2 shift;
  double turn = 0;

  double along(Vec2 n, Vec2 arm) const { return dot(shift, n) + turn * cross(arm, n); }
  void push(Vec2 n, Vec2 arm, double inverse_mass, double inverse_inertia, double impulse)
  {
    shift = shift + (inverse_mass * impulse) * n;
    turn += inverse_inertia * impulse * cross(arm, n);
  }
};

/// A shape as contacts push it. What cannot move has no inverse mass and inertia.
struct Contact_body
{
  Vec2 centre;
  double inverse_mass = 0, inverse_inertia = 0;
  Contact_motion motion = {};

  bool is_fixed() const { return inverse_mass == 0; }
};

/// Keeps the deepest contact and up to three others that are `distance` away from each other.
inline void thin_contacts(std::vector<Contact>& contacts, double distance)
{
  std::array<Contact, 4> kept;
  std::size_t n = 0;
  while (n < kept.size()) {
    const Contact* deepest = nullptr;
    for (const Contact& c : contacts) {
      bool is_apart = deepest == nullptr || c.depth > deepest->depth;
      for (std::size_t k = 0; k < n && is_apart; ++k)
        is_apart = length(c.point - kept[k].point) > distance;
      if (is_apart)
        deepest = &c;
    }
    if (!deepest)
      break;
    kept[n++] = *deepest;
  }
  contacts.assign(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(n));
}

/// The motions that end at most four contacts of two bodies together, the first away from the second: rounds
/// of impulses that only push (sequential impulses, Catto 2005).
inline void push_apart(const std::vector<Contact>& contacts, Contact_body& a, Contact_body& b)
{
  std::array<double, 4> impulses{};
  for (int round = 0; round < 4; ++round)
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Contact& c = contacts[k];
      const Vec2 ra = c.point - a.centre, rb = c.point - b.centre;
      const double ca = cross(ra, c.normal), cb = cross(rb, c.normal);
      const double missing = c.depth - a.motion.along(c.normal, ra) + b.motion.along(c.normal, rb);
      const double before = impulses[k];
      impulses[k] =
          std::max(0.0, before + missing / (a.inverse_mass + b.inverse_mass + ca * ca * a.inverse_inertia +
                                            cb * cb * b.inverse_inertia));
      a.motion.push(c.normal, ra, a.inverse_mass, a.inverse_inertia, impulses[k] - before);
      b.motion.push(c.normal, rb, b.inverse_mass, b.inverse_inertia, before - impulses[k]);
    }
}

/// The motion that takes a body out of walls, whose normals point inwards.
inline void push_from_walls(const std::array<Contact, 4>& walls, Contact_body& body)
{
  for (int round = 0; round < 3; ++round)
    for (const Contact& c : walls)
      if (c.depth > 0) {
        const Vec2 arm = c.point - body.centre;
        const double k = cross(arm, c.normal), missing = c.depth - body.motion.along(c.normal, arm);
        if (missing > 0)
          body.motion.push(c.normal, arm, body.inverse_mass, body.inverse_inertia,
                           missing / (body.inverse_mass + k * k * body.inverse_inertia));
      }
}

} // namespace Atlas::internal

#endif
