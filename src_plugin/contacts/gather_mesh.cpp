// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/gather_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "atom.h"
#include "contacts/contact_law.h"
#include "contacts/rod_kinds.h"
#include "core/closest_points.h"
#include "fix_mesh_surface.h"
#include "fix_wall_gran.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// How well a contact goes on as one of the last step: the less, the better.
constexpr int kSamePart = 0, kSameTriangle = 1, kSamePatch = 2, kNeighbour = 3, kStranger = 4;

}  // namespace

void MeshGatherer::begin(const FixWallGran &fix, const MeshSurface &mesh, int number,
                         MeshHistories &histories, bool effective_mass, bool types_are_kinds,
                         const JointShares *shares)
{
  shares_ = shares;
  fix_ = &fix;
  mesh_ = &mesh;
  number_ = number;
  histories_ = &histories;
  wall_type_ = mesh.fix().atomTypeWall();
  turning_ = effective_mass ? 1.0 : 0.0;
  types_are_kinds_ = types_are_kinds;
  pierced_rod_ = -1;
}

// What is kept of other meshes stays where it is.
void MeshGatherer::take_before()
{
  before_.clear();
  MeshHistories::Contacts &kept = histories_->of(rod_);
  for (size_t k = 0; k < kept.size();) {
    if (kept[k].mesh != number_) {
      k++;
      continue;
    }
    before_.push_back(std::move(kept[k]));
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

// Where they were, in the triangles of now.
void MeshGatherer::remember()
{
  remembered_.clear();
  triangles_before_.clear();
  for (const MeshHistories::Contact &contact : before_) {
    triangles_before_.push_back(
        contact.topology == mesh_->topology()
            ? contact.triangle
            : mesh_->triangle_of(contact.triangle_id, capsule_.segment.at(contact.along)));
    if (triangles_before_.back() >= 0)
      remembered_.push_back({static_cast<OnRod>(contact.place), triangles_before_.back(),
                             contact.part, contact.normal});
  }
}

// At a joint of a fibre the neighbour's end is at the same face; an edge or a corner is another rod, of no
// thickness.
void MeshGatherer::share()
{
  const TriangleSurface &surface = mesh_->surface();
  const Vec3 &axis = capsule_.segment.axis;
  for (SurfaceContact &contact : found_) {
    if (contact.feature == OnSurface::kFace) {
      contact.weight *= shares_->of_end(rod_, contact.place == OnRod::kEndPlus, fix_->groupbit);
      continue;
    }
    const Segment feature = contact.feature == OnSurface::kEdge
                                ? surface.segment(contact.index)
                                : Segment{surface.node(contact.index), axis, 0.0};
    const JointShares::Share at_joint =
        shares_->of_rod(rod_, capsule_, contact.along, feature, capsule_.radius, fix_->groupbit);
    contact.weight *= at_joint.share;
    if (at_joint.beyond == 0.0 || !(contact.distance > 0.0)) continue;
    const ClosestPoints points = on_rods(
        closest_points(extended(capsule_.segment, at_joint.beyond), feature), at_joint.beyond, 0.0);
    contact.along = points.s;
    contact.distance = std::sqrt(points.distance_squared);
    contact.normal = (1.0 / contact.distance) * points.delta;
  }
  const auto is_nothing = [](const SurfaceContact &contact) { return !(contact.weight > 0.0); };
  found_.erase(std::remove_if(found_.begin(), found_.end(), is_nothing), found_.end());
}

int MeshGatherer::find(const RodsNearMesh::Near &near, ContactLaw &law)
{
  rod_ = near.rod;
  capsule_ = static_cast<const AtomVecSpherocylinder &>(*atom->avec).capsule(rod_);
  take_before();
  remember();
  find_contacts(capsule_, mesh_->surface(), near.features, remembered_, found_);
  if (shares_) share();
  match();
  if (!near.features.pierced.empty() && remembered_.empty() && pierced_rod_ < 0) {
    pierced_rod_ = rod_;
    pierced_triangle_ = near.features.pierced.front();
  }
  for (MeshHistories::Contact &contact : before_)
    if (contact.mesh == number_ && !contact.values.empty())
      law.contact_ended(rod_, -1, nullptr, contact.values.data());
  return static_cast<int>(found_.size());
}

void MeshGatherer::forget(int rod, ContactLaw &law)
{
  rod_ = rod;
  take_before();
  found_.clear();
  for (MeshHistories::Contact &contact : before_)
    if (!contact.values.empty()) law.contact_ended(rod_, -1, nullptr, contact.values.data());
}

int MeshGatherer::agreement(const SurfaceContact &now, size_t before) const
{
  const MeshHistories::Contact &then = before_[before];
  const int triangle = triangles_before_[before];
  if (then.mesh != number_ || then.place != static_cast<int>(now.place) || triangle < 0)
    return kStranger;
  if (triangle == now.triangle) return then.part == now.part ? kSamePart : kSameTriangle;
  const TriangleSurface &surface = mesh_->surface();
  if (surface.patch(triangle) == surface.patch(now.triangle)) return kSamePatch;
  return dot(then.normal, now.normal) > 0.0 && surface.are_neighbours(triangle, now.triangle)
             ? kNeighbour
             : kStranger;
}

// Those found take over what is kept; what is left in before_ with this mesh's number has ended.
void MeshGatherer::match()
{
  constexpr int kNone = -1;
  std::vector<int> &source = source_;
  source.assign(found_.size(), kNone);
  for (int worst = kSamePart; worst < kStranger; worst++)
    for (size_t k = 0; k < found_.size(); k++) {
      if (source[k] != kNone) continue;
      double nearest = 0.0;
      for (size_t before = 0; before < before_.size(); before++) {
        const bool is_taken =
            std::find(source.begin(), source.end(), static_cast<int>(before)) != source.end();
        if (is_taken || agreement(found_[k], before) != worst) continue;
        const double apart = std::fabs(before_[before].along - found_[k].along);
        if (source[k] != kNone && apart >= nearest) continue;
        source[k] = static_cast<int>(before);
        nearest = apart;
      }
    }

  MeshHistories::Contacts &kept = histories_->of(rod_);
  for (size_t k = 0; k < found_.size(); k++) {
    const SurfaceContact &contact = found_[k];
    std::vector<double> values(source[k] == kNone ? histories_->values() : 0, 0.0);
    if (source[k] != kNone) {
      values = std::move(before_[source[k]].values);
      before_[source[k]].mesh = kNone;
    }
    kept.push_back(
        {number_, static_cast<int>(contact.place), mesh_->id(contact.triangle), contact.part,
         contact.along, contact.normal,
         contact.on_axis(capsule_.segment) - mesh_->surface().shape(contact.triangle).centre(),
         std::move(values), contact.triangle, mesh_->topology()});
  }
}

// Meshes of a wall may be of different types.
int64_t MeshGatherer::kind_of(int type) const
{
  return type + static_cast<int64_t>(atom->ntypes + 1) * wall_type_;
}

// Of the effective mass at the contact what damping goes by: as coupling_of_ends has it, but for contacts of
// any number that have a part of a load. A push w f at each makes the contact's point give way by
// w K11 + sum of w' K1' over the others that act as one with it.
double MeshGatherer::mass_share(size_t k, const InverseInertia &inverse) const
{
  const SurfaceContact &one = found_[k];
  if (found_.size() == 1 && one.weight == 1.0) return 1.0;
  const Vec3 arm = one.along * capsule_.segment.axis;
  const double alone = inverse_effective_mass(inverse, arm, one.normal);
  double sum = one.weight * alone;
  for (size_t other = 0; turning_ > 0.0 && other < found_.size(); other++) {
    const SurfaceContact &b = found_[other];
    const double overlap = capsule_.radius - one.distance, of_other = capsule_.radius - b.distance;
    if (other == k || !(overlap > 0.0) || !(of_other > 0.0)) continue;
    const double share = std::min(overlap, of_other) / std::max(overlap, of_other) * b.weight *
                         std::max(0.0, dot(one.normal, b.normal));
    sum +=
        share * mass_coupling(inverse, arm, one.normal, b.along * capsule_.segment.axis, b.normal);
  }
  // Two contacts leave half of it at least; more could leave nothing.
  constexpr double kLeast = 0.25;
  return alone / std::max(sum, kLeast * one.weight * alone);
}

int MeshGatherer::add(ContactBatch &batch, int first)
{
  const int i = rod_;
  const InverseInertia inverse = {1.0 / atom->rmass[i], turning_ / atom->inertia[i][0]};
  MeshHistories::Contacts &kept = histories_->of(i);
  const size_t first_kept = kept.size() - found_.size();
  ContactArms &arms = batch.arms;
  const int room = kBatch - batch.count;
  const int end = std::min(static_cast<int>(found_.size()), first + room);
  for (int n = first; n < end; n++) {
    const SurfaceContact &contact = found_[n];
    const Vec3 arm = contact.along * capsule_.segment.axis;
    const int k = batch.count++;
    batch.i[k] = i;
    batch.j[k] = -1;
    batch.type_i[k] = atom->type[i];
    batch.type_j[k] = wall_type_;
    batch.kind[k] = types_are_kinds_ ? kind_of(atom->type[i]) : RodKinds::kNone;
    batch.end[k] = contact.triangle;
    batch.flags[k] = nullptr;
    std::vector<double> &values = kept[first_kept + n].values;
    batch.history[k] = values.empty() ? nullptr : values.data();
    batch.weight[k] = contact.weight;
    arms.arm_i.set(k, arm);
    arms.velocity_i.set(k, load(atom->v[i]));
    arms.velocity_j.set(k, mesh_->velocity(contact.triangle, contact.on_surface(capsule_.segment)));
    arms.omega_i.set(k, load(atom->omega[i]));
    arms.inverse_mass_i[k] = inverse.mass;
    arms.inverse_inertia_i[k] = inverse.transverse;
    arms.radius_i[k] = capsule_.radius;
    arms.normal.set(k, contact.normal);
    arms.distance[k] = contact.distance;
    arms.overlap[k] = capsule_.radius - contact.distance;
    arms.mass_share[k] = mass_share(n, inverse);
    arms.side.set(k, kZero);
  }
  return end;
}
