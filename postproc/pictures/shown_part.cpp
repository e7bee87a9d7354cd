// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/shown_part.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "io/input_error.h"
#include "io/mesh_file.h"
#include "pictures/mesh_surface.h"
#include "pictures/vessel_surface.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Box nothing()
{
  Box box;
  box.fill({kInfinity, -kInfinity});
  return box;
}

void include(std::array<double, 2> &range, double low, double high)
{
  range[0] = std::min(range[0], low);
  range[1] = std::max(range[1], high);
}

Box reach_of(const std::vector<Rod> &rods)
{
  Box box = nothing();
  for (const Rod &rod : rods) {
    const Segment &s = rod.capsule.segment;
    const double centre[] = {s.centre.x, s.centre.y, s.centre.z};
    const double axis[] = {s.axis.x, s.axis.y, s.axis.z};
    for (int i = 0; i < 3; i++) {
      const double reach = std::abs(axis[i]) * s.half_length + rod.capsule.radius;
      include(box[i], centre[i] - reach, centre[i] + reach);
    }
  }
  return box;
}

// The directions in which a box has edges. The bounds of a tilted one are not its edges.
std::array<bool, 3> edged(const DumpFrame &frame)
{
  return frame.box_is_tilted ? std::array<bool, 3>{} : frame.periodic;
}

// A floor without a vessel is a plane of its own.
VesselOptions without_free_floor(VesselOptions options)
{
  if (!options.radius) options.floor.reset();
  return options;
}

}  // namespace

void add_vessel_axis_option(CLI::App &app, std::optional<std::string> &axis)
{
  app.add_option("--vessel-axis", axis,
                 "x, y or z: direction of the vessel's axis, default z; --centre is then the "
                 "axis's place in the two others, --floor the lower end along it")
      ->check(CLI::IsMember({"x", "y", "z"}));
}

int vessel_axis_of(const std::optional<std::string> &axis, const VesselOptions &vessel)
{
  if (!axis) return 2;
  if (!vessel.radius) throw InputError("--vessel-axis: wanted with --vessel-radius only");
  return (*axis)[0] - 'x';
}

std::optional<Vessel> vessel_about(int axis, const VesselOptions &options)
{
  std::optional<Vessel> vessel = options.walled_vessel();
  // X Z in the user's order is Z X in cyclic order.
  if (vessel && axis == 1) std::swap(vessel->x, vessel->y);
  return vessel;
}

ShownPart::ShownPart(const PartOptions &options, View view, bool several)
    : options_(options),
      view_(view),
      several_(several),
      axis_(vessel_axis_of(options.vessel_axis, options.vessel)),
      vessel_(vessel_about(axis_, without_free_floor(options.vessel))),
      floor_(options.vessel.radius ? std::nullopt : options.vessel.floor),
      reach_(nothing()),
      bounds_(nothing()),
      seen_(view)
{
  if (options.vessel_height && !vessel_)
    throw InputError("--vessel-height: wanted with --vessel-radius only");
  if (!options.box.empty()) {
    if (vessel_)
      throw InputError("--box: wanted without --vessel-radius, which says what is shown");
    box_ = box_of(options.box, "--box");
  }
  if (vessel_ && !is_upright() &&
      options.vessel_height.has_value() != options.vessel.floor.has_value())
    throw InputError(
        fmt::format("--floor, --vessel-height: must be given together with --vessel-axis {} (got "
                    "one of them)",
                    *options.vessel_axis));
  if (options.top && vessel_ && is_upright() && *options.top <= vessel_->floor)
    throw InputError(
        fmt::format("--top: must be above the floor {} (got {})", vessel_->floor, *options.top));
  if (options.cut && view == View::Top)
    throw InputError("--cut: needs a view from the side or oblique (got 'top')");
}

void ShownPart::look_at(const DumpFrame &frame, const std::vector<Rod> &rods)
{
  std::vector<Rod> kept;
  for (const Rod &rod : rods)
    if (is_kept(rod)) kept.push_back(rod);
  need_inside(frame, kept);
  if (rods.empty()) return;
  for (const DrawnMesh &mesh : meshes_at(frame.step)) seen_.include(mesh.surface);
  if (kept.empty()) return;
  const Box reach = reach_of(kept);
  const auto periodic = edged(frame);
  for (int i = 0; i < 3; i++) {
    include(reach_[i], reach[i][0], reach[i][1]);
    const auto &[low, high] = periodic[i] ? frame.box[i] : reach[i];
    include(bounds_[i], low, high);
  }
  seen_.include(kept);
  if (const auto box = edges(frame))
    for (const Vec3 &corner : corners_of(box_ ? *box : bounds_)) seen_.include(corner);
}

bool ShownPart::is_kept(const Rod &rod) const
{
  if (options_.top && highest_point(rod.capsule) > *options_.top) return false;
  if (!box_) return true;
  const Vec3 &c = rod.capsule.segment.centre;
  return c.x >= box_->x_low && c.x <= box_->x_high && c.y >= box_->y_low && c.y <= box_->y_high &&
         c.z >= box_->z_low && c.z <= box_->z_high;
}

void ShownPart::need_inside(const DumpFrame &frame, const std::vector<Rod> &kept) const
{
  if (floor_) need_rods_inside({frame, kept, 0}, Vessel{0.0, 0.0, kInfinity, *floor_});
  if (!vessel_) return;
  if (is_upright()) {
    need_rods_inside({frame, kept, 0}, *vessel_);
    return;
  }
  const Ends along = given_ends().value_or(Ends{-kInfinity, kInfinity});
  const auto outside = std::count_if(kept.begin(), kept.end(), [&](const Rod &rod) {
    const Vec3 c = to_vessel(rod.capsule.segment.centre, axis_);
    return std::hypot(c.x - vessel_->x, c.y - vessel_->y) > vessel_->radius || c.z < along.low ||
           c.z > along.high;
  });
  if (outside == 0) return;
  const Vec3 at = to_space({vessel_->x, vessel_->y, 0.0}, axis_);
  const std::string length =
      given_ends() ? fmt::format(" from {} to {}", along.low, along.high) : "";
  throw InputError(fmt::format(
      "{}: step {}: {} of {} rod centres are outside the vessel of radius {} along {}{} through "
      "({}, {}, {}), wanted none",
      frame.path, frame.step, outside, kept.size(), vessel_->radius, *options_.vessel_axis, length,
      at.x, at.y, at.z));
}

std::optional<ShownPart::Ends> ShownPart::given_ends() const
{
  if (!options_.vessel_height) return std::nullopt;
  return Ends{vessel_->floor, vessel_->floor + *options_.vessel_height};
}

ShownPart::Ends ShownPart::ends() const
{
  return given_ends().value_or(Ends{bounds_[axis_][0], bounds_[axis_][1]});
}

double ShownPart::middle_y() const
{
  if (box_) return 0.5 * (box_->y_low + box_->y_high);
  if (!vessel_) return 0.5 * (bounds_[1][0] + bounds_[1][1]);
  return to_space({vessel_->x, vessel_->y, 0.5 * (ends().low + ends().high)}, axis_).y;
}

// What stands upright and is round is cut facing the viewer; else along x, as the sides of a box
// and the axis of a drum lie.
bool ShownPart::is_cut_off(const Rod &rod) const
{
  const Vec3 &centre = rod.capsule.segment.centre;
  if (!vessel_ || !is_upright()) return centre.y < middle_y();
  const Vec3 from_axis{centre.x - vessel_->x, centre.y - vessel_->y, 0.0};
  return dot(from_axis, frame_of(view_).towards) > 0.0;
}

std::vector<std::size_t> ShownPart::rods_shown(const std::vector<Rod> &rods) const
{
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < rods.size(); i++)
    if (is_kept(rods[i]) && !(options_.cut && is_cut_off(rods[i]))) shown.push_back(i);
  return shown;
}

bool ShownPart::may_be_empty() const
{
  if (vessel_ && is_upright() && options_.top) return true;
  return several_ && !seen_.is_empty();
}

std::string ShownPart::left_out_by() const
{
  std::vector<std::string> names;
  if (box_) names.push_back("--box");
  if (options_.top) names.push_back("--top");
  if (options_.cut) names.push_back("--cut");
  return fmt::format("{}", fmt::join(names, ", "));
}

// Upright: up to --top, or only the part that holds rods, and a little more. Lying: from end to
// end, or as far as rods reach.
DrawnVessel ShownPart::drawn_vessel() const
{
  const bool ends_given = options_.vessel_height.has_value();
  if (!is_upright()) {
    const UprightCylinder cylinder{vessel_->x, vessel_->y, vessel_->radius, ends().low,
                                   ends().high};
    return {cylinder, axis_, !ends_given, !ends_given};
  }
  const double bed = reach_[2][1] - vessel_->floor;
  const double part =
      options_.top ? *options_.top - vessel_->floor : 1.1 * std::max(bed, 0.25 * vessel_->radius);
  const double whole = options_.vessel_height.value_or(kInfinity);
  return {vessel_up_to(*vessel_, vessel_->floor + std::min(part, whole)), axis_, false,
          part < whole};
}

// Of --box, or of the dump's box in the directions in which it is periodic, with what holds the
// rods in the others.
std::optional<Box> ShownPart::edges(const DumpFrame &frame) const
{
  if (vessel_) return std::nullopt;
  if (box_)
    return Box{
        {{box_->x_low, box_->x_high}, {box_->y_low, box_->y_high}, {box_->z_low, box_->z_high}}};
  const auto periodic = edged(frame);
  if (std::find(periodic.begin(), periodic.end(), true) == periodic.end()) return std::nullopt;
  Box box = frame.box;
  for (int i = 0; i < 3; i++)
    if (!periodic[i]) box[i] = reach_[i];
  return box;
}

// What is left of a mesh by --box and --top.
vtkSmartPointer<vtkPolyData> ShownPart::shown_mesh(const std::string &file) const
{
  const auto mesh = read_mesh(file);
  UprightBox room = box_.value_or(
      UprightBox(-kInfinity, kInfinity, -kInfinity, kInfinity, -kInfinity, kInfinity));
  room.z_high = std::min(room.z_high, options_.top.value_or(kInfinity));
  return mesh_within(mesh, room);
}

std::vector<DrawnMesh> ShownPart::meshes_at(std::int64_t step) const
{
  std::vector<DrawnMesh> found;
  const auto add = [&](DrawnMesh::Kind kind, const std::string &name) {
    const std::string file = mesh_file_at(name, step);
    const bool of_all_steps = file == name;
    vtkSmartPointer<vtkPolyData> mesh = of_all_steps ? meshes_[file] : nullptr;
    if (!mesh) mesh = shown_mesh(file);
    if (of_all_steps) meshes_[file] = mesh;
    if (mesh->GetNumberOfPolys() > 0) found.push_back({kind, mesh});
  };
  for (const std::string &name : options_.meshes) add(DrawnMesh::Kind::Walls, name);
  for (const std::string &name : options_.bodies) add(DrawnMesh::Kind::Body, name);
  return found;
}

// Over the box, or what rods reach and a tenth more.
DrawnMesh ShownPart::floor_below(const DumpFrame &frame) const
{
  Box under = reach_;
  for (int i = 0; i < 2; i++) {
    const double rim = 0.1 * (reach_[i][1] - reach_[i][0]);
    under[i] = {reach_[i][0] - rim, reach_[i][1] + rim};
  }
  const auto box = edges(frame);
  for (int i = 0; box && i < 2; i++)
    if (box_ || frame.periodic[i]) under[i] = (*box)[i];
  const UprightBox sides(under[0][0], under[0][1], under[1][0], under[1][1], *floor_, *floor_);
  return {DrawnMesh::Kind::Floor, level_plane(sides, *floor_)};
}

void ShownPart::set(PictureOptions &picture, const DumpFrame &frame) const
{
  picture.meshes = meshes_at(frame.step);
  if (floor_ && reach_[0][0] < reach_[0][1]) picture.meshes.push_back(floor_below(frame));
  if (vessel_) picture.vessel = drawn_vessel();
  picture.box = edges(frame);
  const bool only_vessel = vessel_ && is_upright() && options_.top;
  picture.aim_at_rods = !several_ && !only_vessel;
  if (several_ && !only_vessel) picture.seen = seen_;
}

}  // namespace spherocylinder
