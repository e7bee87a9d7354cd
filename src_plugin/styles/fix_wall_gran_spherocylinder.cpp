// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_wall_gran_spherocylinder.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "atom.h"
#include "comm.h"
#include "core/overlapping_facets.h"
#include "domain.h"
#include "fix_mesh_surface.h"
#include "fix_property_atom.h"
#include "host/private_members.h"
#include "host/rod_error.h"
#include "input.h"
#include "modify.h"
#include "neighbor.h"
#include "primitive_wall.h"
#include "rods/atom_vec_spherocylinder.h"
#include "styles/fix_neighlist_mesh_spherocylinder.h"
#include "update.h"
#include "variable.h"

using namespace LAMMPS_NS;

using spherocylinder::load;
using spherocylinder::Vec3;

namespace {

// LIGGGHTS lists rods within its skin of the wall, of which rods that lie still may use none and
// moving ones half before it lists them anew.
constexpr double kUsedOfSkin = 0.4;

// Of what_is_kept(), before those of meshes.
constexpr int kModelsNumbers = 4;

FixNeighlistMeshSpherocylinder *list_of(const MeshSurface &mesh)
{
  return dynamic_cast<FixNeighlistMeshSpherocylinder *>(mesh.fix().meshNeighlist());
}

// 0, 1 or 2 for x, y or z.
int axis_of(const WallSurface &surface)
{
  return surface.direction.x != 0.0 ? 0 : surface.direction.y != 0.0 ? 1 : 2;
}

}  // namespace

FixWallGranSpherocylinder::FixWallGranSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixWallGranSpherocylinder(lmp, WallArguments(lmp, narg, arg))
{
}

FixWallGranSpherocylinder::FixWallGranSpherocylinder(LAMMPS *lmp, WallArguments arguments)
    : FixWallGran(lmp, static_cast<int>(arguments.others.size()), arguments.others.data()),
      near_rods_(lmp),
      arguments_(std::move(arguments))
{
  if (arguments_.turns && !primitiveWall_)
    rod_error_all(lmp, "Fix wall/gran (id %s): turn is for a plane (got no primitive wall)", id);
  arguments_.others.clear();  // the deck's line is not kept
  rod_wall_ = dynamic_cast<RodWall *>(impl);
  restart_global = has_variable() || is_mesh_wall() || history_values() > 0;
  begin_meshes();
  if (!primitiveWall_) return;
  const double radius = wall_parameters(*primitiveWall_)[0];
  if (surface_of(*primitiveWall_).is_cylinder && !(radius > 0.0 && std::isfinite(radius)))
    rod_error_all(lmp, "Fix wall/gran (id %s): the cylinder's radius must be > 0 (got %g)", id,
                  radius);
  check_shear();
}

void FixWallGranSpherocylinder::check_shear() const
{
  const WallSurface surface = surface_of(*primitiveWall_);
  if (arguments_.turns && surface.is_cylinder)
    rod_error_all(lmp,
                  "Fix wall/gran (id %s): turn is for a plane; a cylinder turns by shear along "
                  "another direction than its axis",
                  id);
  if (shear_ && !surface.is_cylinder && shearDim_ == axis_of(surface))
    rod_error_all(
        lmp,
        "Fix wall/gran (id %s): shear %c is along the plane's normal, wanted one along the "
        "plane; a plane turns about its normal by turn rate c1 c2, and moves along it by a "
        "variable as its position",
        id, 'x' + shearDim_);
}

void FixWallGranSpherocylinder::init()
{
  FixWallGran::init();
  rod_wall_ = dynamic_cast<RodWall *>(impl);
  if (primitiveWall_) wall_ = moving_wall();
  if (has_variable()) find_variable();
  look_at_rods();
  near_rods_.forget();
  for (WallMesh &mesh : meshes_) mesh.rods.forget();
  last_known_id_ = 0;
  if (is_mesh_wall()) largest_id_ = atom->tag_max();
  meshes_may_be_others_ = true;
}

void FixWallGranSpherocylinder::check_cylinder_is_wide_enough() const
{
  if (wall_.surface.is_cylinder && thickest_in_ >= wall_.surface.radius)
    rod_error_one(lmp,
                  "Fix wall/gran (id %s): the cylinder's radius %g must be larger than that of the "
                  "thickest rod (got %g)",
                  id, wall_.surface.radius, thickest_in_);
}

// LIGGGHTS shows a wall to the rods of the box, not to their images beyond a periodic face.
void FixWallGranSpherocylinder::check_no_image_is_missed() const
{
  const WallSurface &surface = wall_.surface;
  const double *direction = &surface.direction.x, *point = &surface.point.x;
  for (int d = 0; d < 3; d++) {
    if (!domain->periodicity[d]) continue;
    const bool is_normal = direction[d] != 0.0;
    if (!surface.is_cylinder && is_normal)
      rod_error_all(lmp,
                    "Fix wall/gran (id %s): a plane across the periodic direction %c would not be "
                    "seen from the other side of the box; wanted boundary f, s or m there",
                    id, 'x' + d);
    if (surface.is_cylinder && !is_normal &&
        (point[d] - surface.radius < domain->boxlo[d] + longest_out_ ||
         point[d] + surface.radius > domain->boxhi[d] - longest_out_))
      rod_error_one(
          lmp,
          "Fix wall/gran (id %s): the cylinder from %g to %g in the periodic direction %c "
          "must lie within the box, %g to %g, by half the length of the longest rod outside of it, %g",
          id, point[d] - surface.radius, point[d] + surface.radius, 'x' + d, domain->boxlo[d],
          domain->boxhi[d], longest_out_);
  }
}

const char *FixWallGranSpherocylinder::what_varies() const
{
  return wall_.surface.is_cylinder ? "the cylinder's radius" : "the plane's position";
}

void FixWallGranSpherocylinder::find_variable()
{
  std::string &name = arguments_.variable;
  variable_ = input->variable->find(&name[0]);
  if (variable_ < 0 || !input->variable->equalstyle(variable_))
    rod_error_all(lmp, "Fix wall/gran (id %s): variable %s for %s must be of style equal (got %s)",
                  id, name.c_str(), what_varies(),
                  variable_ < 0 ? "none of this name" : "another style");
}

// The wall goes where the variable is now. It has got there from where it was a step ago.
void FixWallGranSpherocylinder::move_wall()
{
  modify->clearstep_compute();
  const double place = input->variable->compute_equal(variable_);
  modify->addstep_compute(update->ntimestep + 1);
  const bool is_cylinder = wall_.surface.is_cylinder;
  if (!std::isfinite(place) || (is_cylinder && !(place > 0.0)))
    rod_error_all(
        lmp,
        "Fix wall/gran (id %s): variable %s for %s must be a number%s (got %g at step " BIGINT_FORMAT
        ")",
        id, arguments_.variable.c_str(), what_varies(), is_cylinder ? " > 0" : "", place,
        update->ntimestep);

  const double way = place - place_;
  const bool is_put_there = place_step_ != update->ntimestep - 1;
  if (!is_put_there) {
    if (thinnest_ > 0.0 && std::fabs(way) > thinnest_)
      rod_error_one(lmp,
                    "Fix wall/gran (id %s): %s jumps by %g at step " BIGINT_FORMAT
                    ", wanted at most the thinnest rod's radius %g a step",
                    id, what_varies(), way, update->ntimestep, thinnest_);
    speed_ = way / update->dt;
  } else if (place_step_ != update->ntimestep || way != 0.0) {
    speed_ = 0.0;  // put there between runs
  }
  place_ = place;
  place_step_ = update->ntimestep;

  wall_parameters(*primitiveWall_)[0] = place;
  wall_ = moving_wall();
  if (is_cylinder) {
    if (is_put_there) read_sizes();
    check_cylinder_is_wide_enough();
    check_no_image_is_missed();
  }
  if (std::fabs(place - listed_place_) > kUsedOfSkin * neighbor->skin)
    rebuildPrimitiveNeighlist_ = true;
}

void FixWallGranSpherocylinder::write_restart(FILE *file)
{
  if (comm->me != 0) return;
  std::vector<double> state = what_is_kept();
  state.insert(state.end(), {place_, speed_, static_cast<double>(place_step_)});
  const int size = static_cast<int>(state.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, file);
  fwrite(state.data(), 1, size, file);
}

// It may have had no variable, or no meshes, when the file was written.
void FixWallGranSpherocylinder::restart(char *state)
{
  const double *values = reinterpret_cast<const double *>(state);
  const size_t sizes = kModelsNumbers + 2 * static_cast<size_t>(values[0]);
  const bool was_mesh_wall = values[0] > 0.0;
  if (is_mesh_wall() && was_mesh_wall) kept_.assign(values, values + sizes);
  const bool both_keep_values = values[1] > 0.0 && history_values() > 0;
  if (primitiveWall_ && !was_mesh_wall && both_keep_values) check_models_are_kept_ones(values);
  if (!has_variable()) return;
  place_ = values[sizes];
  speed_ = values[sizes + 1];
  place_step_ = static_cast<bigint>(values[sizes + 2]);
}

// LIGGGHTS gives `shear` along the cylinder's axis as a velocity, across it as a rate about the
// axis.
MovingWall FixWallGranSpherocylinder::moving_wall() const
{
  constexpr Vec3 kZero = {0.0, 0.0, 0.0};
  MovingWall wall{surface_of(*primitiveWall_), kZero, kZero, kZero};
  const WallSurface &surface = wall.surface;
  if (shear_ && surface.is_cylinder && shearAxis_ >= 0) {
    wall.turning = load(shearAxisVec_);
  } else if (shear_) {
    double sliding[3] = {0.0, 0.0, 0.0};
    sliding[shearDim_] = vshear_;
    wall.sliding = load(sliding);
  }
  if (arguments_.turns) {
    double centre[3] = {0.0, 0.0, 0.0};
    const int axis = axis_of(surface);
    centre[(axis + 1) % 3] = arguments_.centre[0];
    centre[(axis + 2) % 3] = arguments_.centre[1];
    wall.centre = load(centre);
    wall.turning = arguments_.turning * surface.direction;
  }
  if (surface.is_cylinder)
    wall.growing = speed_;
  else
    wall.sliding = wall.sliding + speed_ * surface.direction;
  return wall;
}

void FixWallGranSpherocylinder::pre_neighbor()
{
  FixWallGran::pre_neighbor();
  look_at_rods();
  if (is_mesh_wall()) largest_id_ = atom->tag_max();
  for (WallMesh &mesh : meshes_) mesh.rods.forget();
  meshes_may_be_others_ = true;
}

// Rods may have come or gone. (How large a cylinder with a variable is shows when it is moved.)
void FixWallGranSpherocylinder::look_at_rods()
{
  read_sizes();
  if (!primitiveWall_ || (has_variable() && wall_.surface.is_cylinder)) return;
  check_cylinder_is_wide_enough();
  check_no_image_is_missed();
}

void FixWallGranSpherocylinder::read_sizes()
{
  thinnest_ = thickest_in_ = longest_out_ = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    const double radius = atom->shape[i][0];
    if (i == 0 || radius < thinnest_) thinnest_ = radius;
    if (!primitiveWall_ || !(atom->mask[i] & groupbit)) continue;
    if (wall_.surface.is_outside(load(atom->x[i])))
      longest_out_ = std::max(longest_out_, atom->radius[i]);
    else
      thickest_in_ = std::max(thickest_in_, radius);
  }
}

void FixWallGranSpherocylinder::pre_force(int vflag)
{
  if (has_variable()) move_wall();
  if (rebuildPrimitiveNeighlist_) {
    near_rods_.forget();
    listed_place_ = place_;
  }
  FixWallGran::pre_force(vflag);
}

void FixWallGranSpherocylinder::post_force_primitive(int vflag)
{
  if (!rod_wall_) {
    FixWallGran::post_force_primitive(vflag);
    return;
  }
  double **history = dnum() > 0 ? fix_history_primitive_->array_atom : nullptr;
  int *candidates = nullptr;
  const int count = primitiveWall_->getNeighbors(candidates);
  if (near_rods_.renew(wall_.surface, candidates, count, groupbit) && history)
    forget_contacts_of_far_rods(history);
  rod_wall_->compute_forces(*this, wall_, near_rods_.near(), history);
}

// As LIGGGHTS does: the models forget the contact of a rod within its bounding sphere's reach; of
// one beyond it nothing is left.
void FixWallGranSpherocylinder::forget_contacts_of_far_rods(double **history)
{
  for (const int i : near_rods_.far()) {
    const bool beyond = wall_.surface.gap_of_sphere(load(atom->x[i]), atom->radius[i]) > 0.0;
    if (beyond)
      std::fill_n(history[i], dnum(), 0.0);
    else
      rod_wall_->contacts_ended(i, history[i]);
  }
}

int FixWallGranSpherocylinder::forget_contacts(int groupbit_of_rods)
{
  int forgotten = 0;
  for (int i = 0; is_mesh_wall() && i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit_of_rods)) continue;
    forgotten += mesh_histories_.of(i).empty() ? 0 : 1;
    mesh_histories_.clear(i);
  }
  if (!fix_history_primitive_) return forgotten;
  for (int i = 0; i < atom->nlocal; i++) {
    double *history = fix_history_primitive_->array_atom[i];
    if (!(atom->mask[i] & groupbit_of_rods)) continue;
    if (std::any_of(history, history + dnum(), [](double value) { return value != 0.0; }))
      forgotten++;
    std::fill_n(history, dnum(), 0.0);
  }
  return forgotten;
}

void FixWallGranSpherocylinder::begin_meshes()
{
  if (!is_mesh_wall()) return;
  for (int m = 0; m < n_meshes(); m++)
    if (strcmp(mesh_list()[m]->style, "mesh/surface/planar") == 0)
      rod_error_all(lmp,
                    "Fix wall/gran (id %s): mesh %s is a mesh/surface/planar, which is a face for "
                    "insertion and counting; wanted a mesh/surface as a wall",
                    id, mesh_list()[m]->id);
  for (int m = 0; m < n_meshes(); m++)
    if (std::find(mesh_list(), mesh_list() + m, mesh_list()[m]) != mesh_list() + m)
      rod_error_all(lmp,
                    "Fix wall/gran (id %s): mesh %s is named twice, its contacts would bear twice",
                    id, mesh_list()[m]->id);
  for (int m = 0; m < n_meshes(); m++)
    meshes_.push_back({MeshSurface(*mesh_list()[m], *domain), RodsNearMesh(lmp)});
  mesh_histories_.keep(history_values());
  restart_peratom = 1;
  create_attribute = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixWallGranSpherocylinder::~FixWallGranSpherocylinder()
{
  if (meshes_.empty()) return;
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

// LIGGGHTS's contact history of a mesh knows one contact for a triangle.
void FixWallGranSpherocylinder::post_create()
{
  FixWallGran::post_create();
  for (WallMesh &mesh : meshes_) {
    mesh.surface.fix().deleteContactHistory();
    if (auto *list = list_of(mesh.surface)) list->leave_to_wall();
  }
}

// How many meshes, values of a contact, the models' hash code in two halves, which doubles hold whatever it
// is, and of each mesh triangles and area (m^2).
std::vector<double> FixWallGranSpherocylinder::what_is_kept() const
{
  const uint64_t code = rod_wall_ ? static_cast<uint64_t>(rod_wall_->hashcode()) : 0;
  std::vector<double> kept = {
      static_cast<double>(meshes_.size()), static_cast<double>(history_values()),
      static_cast<double>(code >> 32), static_cast<double>(code & 0xffffffffu)};
  for (const WallMesh &mesh : meshes_) {
    TriMesh &triangles = *mesh.surface.fix().triMesh();
    kept.push_back(triangles.sizeGlobal());
    kept.push_back(triangles.areaMeshGlobal());
  }
  return kept;
}

// The models' values are known by their places alone, of which other models may have as many.
void FixWallGranSpherocylinder::check_models_are_kept_ones(const double *kept)
{
  const std::vector<double> now = what_is_kept();
  if (now[1] != kept[1])
    rod_error_all(
        lmp,
        "Fix wall/gran (id %s): the restart file holds contacts of %g values (got contact "
        "models with %g; expected the same ones, or another id)",
        id, kept[1], now[1]);
  if (kept[1] > 0.0 && !std::equal(now.begin() + 2, now.begin() + kModelsNumbers, kept + 2))
    rod_error_all(
        lmp,
        "Fix wall/gran (id %s): the restart file holds contacts of other contact models, of "
        "%g values each (got models with as many; expected the same models, or another id)",
        id, kept[1]);
}

// Contacts that were read know triangles by their numbers. Asked once, when LIGGGHTS has spread the meshes
// over the ranks.
void FixWallGranSpherocylinder::check_meshes_are_kept_ones()
{
  constexpr double kSameArea = 1e-6;  // of a mesh that has moved, relative
  if (kept_.empty()) return;
  const std::vector<double> size = what_is_kept();
  if (size[0] != kept_[0])
    rod_error_all(lmp,
                  "Fix wall/gran (id %s): the restart file holds its contacts with %g meshes (got "
                  "%g; expected the same meshes and contact models, or another id)",
                  id, kept_[0], size[0]);
  check_models_are_kept_ones(kept_.data());
  for (size_t m = 0; m < meshes_.size(); m++) {
    const double *now = &size[kModelsNumbers + 2 * m], *then = &kept_[kModelsNumbers + 2 * m];
    if (now[0] != then[0] || std::fabs(now[1] - then[1]) > kSameArea * then[1])
      rod_error_all(
          lmp,
          "Fix wall/gran (id %s): the restart file holds contacts with a mesh of %g "
          "triangles and an area of %g where mesh %s is (got %g and %g; expected the same "
          "mesh, or another id)",
          id, then[0], then[1], meshes_[m].surface.fix().id, now[0], now[1]);
  }
  kept_.clear();
}

int FixWallGranSpherocylinder::pack_restart(int rod, double *buffer)
{
  buffer[0] = size_restart(rod);
  return 1 + mesh_histories_.pack(rod, buffer + 1);
}

// Behind the values of the fixes before this one, each beginning with how many it has. Contacts of other
// models are refused before they are used.
void FixWallGranSpherocylinder::unpack_restart(int rod, int nth)
{
  if (kept_.empty() || kept_[1] != mesh_histories_.values()) return;
  const double *values = atom->extra[rod];
  for (int k = 0; k < nth; k++) values += static_cast<int>(values[0]);
  mesh_histories_.unpack(rod, values + 1);
}

int FixWallGranSpherocylinder::maxsize_restart()
{
  int largest = 0;
  for (int i = 0; i < atom->nlocal; i++) largest = std::max(largest, size_restart(i));
  return largest;
}

void FixWallGranSpherocylinder::check_meshes_are_slow() const
{
  for (const WallMesh &mesh : meshes_)
    if (thinnest_ > 0.0 && mesh.surface.step() > thinnest_)
      rod_error_one(lmp,
                    "Fix wall/gran (id %s): mesh %s moves by %g at step " BIGINT_FORMAT
                    ", wanted at most the thinnest rod's radius %g a step",
                    id, mesh.surface.fix().id, mesh.surface.step(), update->ntimestep, thinnest_);
}

// A command may have put rods, or a mesh, elsewhere since the last run: such a rod meets the mesh anew, or
// the side that it was on would pull it back through all that is between. In one step of a run a rod that
// its wall can hold moves by less than its radius.
void FixWallGranSpherocylinder::forget_false_contacts()
{
  const auto &rods = static_cast<const AtomVecSpherocylinder &>(*atom->avec);
  for (int i = 0; i < atom->nlocal; i++) {
    MeshHistories::Contacts &kept = mesh_histories_.of(i);
    if (kept.empty()) continue;
    const spherocylinder::Capsule rod = rods.capsule(i);
    const auto is_false = [&](const MeshHistories::Contact &contact) {
      const MeshSurface &mesh = meshes_[contact.mesh].surface;
      const Vec3 point = rod.segment.at(contact.along);
      const int triangle = mesh.triangle_of(contact.triangle_id, load(atom->x[i]));
      if (triangle < 0) return true;
      const Vec3 place = point - mesh.surface().shape(triangle).centre();
      return norm(mesh.shortest_image(place - contact.place_in_mesh)) > rod.radius;
    };
    for (int m = 0; m < n_meshes(); m++) {
      const auto is_of_mesh = [m](const MeshHistories::Contact &c) { return c.mesh == m; };
      if (std::none_of(kept.begin(), kept.end(), [&](const MeshHistories::Contact &c) {
            return is_of_mesh(c) && is_false(c);
          }))
        continue;
      kept.erase(std::remove_if(kept.begin(), kept.end(), is_of_mesh), kept.end());
      last_known_id_ = 0;  // with `pre no` it may be through a face as well
    }
  }
}

// Of each mesh the triangle with the lowest number, by the rank that owns it.
void FixWallGranSpherocylinder::warn_of_overlapping_facets()
{
  overlaps_are_told_ = true;
  for (const WallMesh &mesh : meshes_) {
    const MeshSurface &surface = mesh.surface;
    const auto [triangle, within] = spherocylinder::find_overlapping_facets(
        surface.surface(), surface.triangle_boxes(), surface.fix().triMesh()->sizeLocal());
    int mine = triangle < 0 ? INT_MAX : surface.id(triangle), lowest = 0;
    MPI_Allreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, world);
    if (triangle >= 0 && mine == lowest)
      rod_warning(
          lmp,
          "Fix wall/gran (id %s): a free edge of triangle %d of mesh %s lies within triangle "
          "%d, which is in the same plane; where they overlap both bear, twice as stiff as one",
          id, mine, surface.fix().id, surface.id(within));
  }
}

void FixWallGranSpherocylinder::post_force_mesh(int vflag)
{
  if (!rod_wall_) {
    FixWallGran::post_force_mesh(vflag);
    return;
  }
  for (WallMesh &mesh : meshes_) {
    if (meshes_may_be_others_)
      mesh.surface.read();
    else
      mesh.surface.follow();
  }
  meshes_may_be_others_ = false;
  check_meshes_are_kept_ones();
  if (!overlaps_are_told_) warn_of_overlapping_facets();
  if (update->setupflag == 0) check_meshes_are_slow();  // else put there between runs
  // With `pre no` a run begins with its first step.
  if (update->setupflag || update->ntimestep == update->firststep + 1) forget_false_contacts();
  for (size_t m = 0; m < meshes_.size(); m++) {
    MeshSurface &mesh = meshes_[m].surface;
    RodsNearMesh &rods = meshes_[m].rods;
    atom_type_wall_ = mesh.fix().atomTypeWall();
    if (store_force_contact()) fix_wallforce_contact_ = mesh.fix().meshforceContact();
    if (store_force_contact_stress())
      fix_wallforce_contact_stress_ = mesh.fix().meshforceContactStress();
    const auto touched = [&, m](int rod, std::vector<int> &triangles) {
      for (const MeshHistories::Contact &contact : mesh_histories_.of(rod)) {
        if (contact.mesh != static_cast<int>(m)) continue;
        const int triangle = mesh.triangle_of(contact.triangle_id, load(atom->x[rod]));
        if (triangle >= 0) triangles.push_back(triangle);
      }
    };
    const bool is_new = rods.renew(mesh, groupbit, last_known_id_, touched);
    if (auto *list = list_of(mesh); list && list->wants_count()) {
      int mine = static_cast<int>(rods.end() - rods.begin()), all = 0;
      MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_SUM, world);
      list->set_count(all);
    }
    rod_wall_->compute_mesh_forces(*this, mesh, static_cast<int>(m), rods, is_new, mesh_histories_);
  }
  last_known_id_ = largest_id_;
}
