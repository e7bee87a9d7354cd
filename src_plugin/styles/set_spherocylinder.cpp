// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/set_spherocylinder.h"

#include <climits>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "core/numbers.h"
#include "domain.h"
#include "force.h"
#include "group.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "input.h"
#include "random_park.h"
#include "region.h"
#include "rods/atom_vec_spherocylinder.h"
#include "set.h"
#include "variable.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

struct Keyword {
  const char *name;
  int values;
};

// What makes up a rod.
constexpr Keyword kOurs[] = {{"diameter", 1},    {"length", 1},      {"shape", 3},
                             {"density", 1},     {"axis", 3},        {"quat", 4},
                             {"quat_direct", 4}, {"quat/random", 1}, {"angmom", 3}};

// LIGGGHTS's own, by the number of values that follow; `property/atom` takes the rest of the line.
// clang-format off
constexpr Keyword kStock[] = {
    {"type", 1},   {"type/fraction", 3}, {"mol", 1},    {"x", 1},        {"y", 1},
    {"z", 1},      {"vx", 1},            {"vy", 1},     {"vz", 1},       {"omegax", 1},
    {"omegay", 1}, {"omegaz", 1},        {"charge", 1}, {"dipole", 3},   {"dipole/random", 2},
    {"theta", 1},  {"image", 3},         {"bond", 1},   {"angle", 1},    {"dihedral", 1},
    {"improper", 1}, {"meso_e", 1},      {"meso_cv", 1}, {"meso_rho", 1}, {"sphkernel", 1},
    {"smd/mass/density", 1}, {"smd/contact/radius", 1}, {"add", 1}, {"until", 1},
    {"property/atom", INT_MAX}};
// clang-format on

struct Refusal {
  const char *name, *instead;
};

constexpr Refusal kRefused[] = {
    {"mass", "use set density: a rod's mass follows from its size and density"},
    {"volume", "use set diameter and length: a rod's volume follows from its size"},
    {"inertiax", "use set diameter, length and density: a rod's inertia follows from them"},
    {"inertiay", "use set diameter, length and density: a rod's inertia follows from them"},
    {"inertiaz", "use set diameter, length and density: a rod's inertia follows from them"},
    {"aspect_ratio", "use set diameter and length"},
    {"blockiness", "a rod is a cylinder with two hemispheres"},
    {"roundness", "a rod is a cylinder with two hemispheres"}};

template <typename Row, size_t N>
const Row *find(const Row (&rows)[N], const char *name)
{
  for (const Row &row : rows)
    if (strcmp(row.name, name) == 0) return &row;
  return nullptr;
}

}  // namespace

SetSpherocylinder::SetSpherocylinder(LAMMPS *lmp)
    : Pointers(lmp), rods_(rods_of(lmp, "Command set of rods"))
{
}

void SetSpherocylinder::command(int narg, char **arg)
{
  if (!domain->box_exist || atom->natoms == 0 || narg < 4 || strcmp(arg[0], "mol") == 0) {
    Set(lmp).command(narg, arg);  // which tells what is wrong
    return;
  }

  std::vector<char *> stock = {arg[0], arg[1]};
  std::vector<Setting> ours;
  bool sets_omega = false;
  for (int k = 2; k < narg;) {
    const char *name = arg[k];
    if (const Refusal *refused = find(kRefused, name))
      rod_error_all(lmp, "Command set: %s cannot be set for rods, %s", name, refused->instead);
    const Keyword *own = find(kOurs, name);
    const Keyword *keyword = own ? own : find(kStock, name);
    const bool is_custom = strncmp(name, "i_", 2) == 0 || strncmp(name, "d_", 2) == 0;
    if (!keyword && !is_custom) rod_error_all(lmp, "Command set: unknown keyword %s", name);
    const int wanted = is_custom ? 1 : keyword->values;
    const int left = narg - k - 1;
    const int count = wanted == INT_MAX ? left : wanted;
    if (count > left || count == 0)
      rod_error_all(lmp, "Command set: %s wants %d values (got %d)", name,
                    wanted == INT_MAX ? 2 : wanted, left);
    if (own) {
      Setting setting = {name, {}};
      for (int value = 1; value <= count; value++)
        setting.values.push_back(value_of(name, arg[k + value]));
      ours.push_back(setting);
    } else {
      stock.insert(stock.end(), arg + k, arg + k + 1 + count);
      sets_omega = sets_omega || strncmp(name, "omega", 5) == 0;
    }
    k += 1 + count;
  }

  const std::vector<int> rods = chosen(arg[0], arg[1]);
  if (stock.size() > 2) Set(lmp).command(static_cast<int>(stock.size()), stock.data());
  if (ours.empty() && !sets_omega) return;
  if (stock.size() == 2 && comm->me == 0 && screen) fprintf(screen, "Setting atom values ...\n");
  apply(ours, rods);
  for (const Setting &setting : ours) report(setting, rods);
}

// This rank's rods that LIGGGHTS's selection words mean.
std::vector<int> SetSpherocylinder::chosen(const char *style, const char *id) const
{
  std::vector<int> rods;
  char *name = const_cast<char *>(id);
  int lowest = 0, highest = 0, groupbit = 0;
  Region *region = nullptr;
  const bool by_id = strcmp(style, "atom") == 0, by_type = strcmp(style, "type") == 0;
  if (by_id || by_type) {
    force->bounds(name, by_id ? INT_MAX : atom->ntypes, lowest, highest);
  } else if (strcmp(style, "group") == 0) {
    const int igroup = group->find(name);
    if (igroup < 0) rod_error_all(lmp, "Command set: group %s does not exist", id);
    groupbit = group->bitmask[igroup];
  } else if (strcmp(style, "region") == 0) {
    const int iregion = domain->find_region(name);
    if (iregion < 0) rod_error_all(lmp, "Command set: region %s does not exist", id);
    region = domain->regions[iregion];
  } else {
    rod_error_all(lmp, "Command set: expected atom, type, group or region (got %s)", style);
  }
  for (int i = 0; i < atom->nlocal; i++) {
    const int number = by_id ? atom->tag[i] : atom->type[i];
    const double *x = atom->x[i];
    if (region     ? region->match(x[0], x[1], x[2]) != 0
        : groupbit ? (atom->mask[i] & groupbit) != 0
                   : number >= lowest && number <= highest)
      rods.push_back(i);
  }
  return rods;
}

SetSpherocylinder::Value SetSpherocylinder::value_of(const char *keyword, const char *word) const
{
  Value value;
  if (strncmp(word, "v_", 2) != 0) {
    char *end = nullptr;
    value.constant = strtod(word, &end);
    if (end == word || *end != '\0' || !std::isfinite(value.constant))
      rod_error_all(lmp, "Command set: %s must be a number or a variable (got %s)", keyword, word);
    return value;
  }
  Variable &variables = *input->variable;
  const int index = variables.find(const_cast<char *>(word + 2));
  if (index < 0) rod_error_all(lmp, "Command set: variable %s does not exist", word + 2);
  if (variables.equalstyle(index)) {
    value.constant = variables.compute_equal(index);
  } else if (variables.atomstyle(index)) {
    value.per_rod.assign(atom->nlocal + 1, 0.0);  // not empty on a rank without rods
    variables.compute_atom(index, 0, value.per_rod.data(), 1, 0);
  } else {
    rod_error_all(lmp, "Command set: variable %s must be of style equal or atom", word + 2);
  }
  return value;
}

void SetSpherocylinder::apply(const std::vector<Setting> &settings, const std::vector<int> &chosen)
{
  for (const int i : chosen) {
    apply_size(settings, i);
    for (const Setting &setting : settings) apply_orientation(setting, i);

    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    const double *inertia = atom->inertia[i];
    const Setting *angmom = nullptr;
    for (const Setting &setting : settings)
      if (setting.keyword == "angmom") angmom = &setting;
    if (angmom) {
      const sc::Vec3 given = {angmom->values[0].at(i), angmom->values[1].at(i),
                              angmom->values[2].at(i)};
      if (inertia[0] == 0.0)
        rod_error_one(lmp,
                      "Command set: angmom of rod %d wants its diameter, length and density first",
                      atom->tag[i]);
      sc::store(given, atom->angmom[i]);
      sc::store(sc::angular_velocity(given, axis, inertia[2], inertia[0]), atom->omega[i]);
    } else {
      sc::store(sc::angular_momentum(sc::load(atom->omega[i]), axis, inertia[2], inertia[0]),
                atom->angmom[i]);
    }
  }
}

// All that the command says of the rod's size is taken together: a rod may become thicker than it
// was long.
void SetSpherocylinder::apply_size(const std::vector<Setting> &settings, int i)
{
  const double *shape = atom->shape[i];
  const double scale = force->cg(atom->type[i]);
  double diameter = 2.0 * shape[0], length = 2.0 * shape[2], density = atom->density[i];
  bool is_given = false;
  for (const Setting &setting : settings) {
    const auto value = [&](int k) {
      const double number = setting.values[k].at(i);
      if (!(number > 0.0) || !std::isfinite(number))
        rod_error_one(lmp, "Command set: %s of rod %d must be > 0 (got %g)",
                      setting.keyword.c_str(), atom->tag[i], number);
      is_given = true;
      return number;
    };
    if (setting.keyword == "diameter") diameter = scale * value(0);
    if (setting.keyword == "length") length = scale * value(0);
    if (setting.keyword == "density") density = value(0);
    if (setting.keyword == "shape") {
      if (value(0) != value(1))
        rod_error_one(
            lmp,
            "Command set: shape of rod %d must be r r L/2, radius twice and half the total "
            "length (got %g %g %g)",
            atom->tag[i], value(0), value(1), value(2));
      diameter = 2.0 * scale * value(0);
      length = 2.0 * scale * value(2);
    }
  }
  if (!is_given) return;
  if (diameter > 0.0 && length > 0.0 && length < diameter)
    rod_error_one(
        lmp,
        "Command set: length of rod %d is the total length and must be >= the diameter %g "
        "(got %g)",
        atom->tag[i], diameter, length);
  rods_.set_rod(i, diameter, length, density, rods_.attached<FibreSegments>().shared_ends(i));
}

void SetSpherocylinder::apply_orientation(const Setting &setting, int i)
{
  const auto value = [&](int k) { return setting.values[k].at(i); };
  double *quaternion = atom->quaternion[i];
  const std::string &keyword = setting.keyword;
  if (keyword == "axis" || keyword == "quat") {
    const sc::Vec3 direction = {value(0), value(1), value(2)};
    const double size = sc::norm(direction);
    if (!(size > 0.0) || !std::isfinite(size))
      rod_error_one(lmp, "Command set: %s of rod %d wants a direction (got %g %g %g)",
                    keyword.c_str(), atom->tag[i], direction.x, direction.y, direction.z);
    const sc::Vec3 unit = (1.0 / size) * direction;
    sc::store(keyword == "axis" ? sc::orientation_of(unit)
                                : sc::rotation_about(unit, value(3) * sc::pi / 180.0),
              quaternion);
  } else if (keyword == "quat_direct") {
    const sc::Quaternion q = {value(0), value(1), value(2), value(3)};
    const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(std::fabs(size - 1.0) <= kQuaternionTolerance))
      rod_error_one(lmp,
                    "Command set: quat_direct of rod %d must have length 1 within %g (got %g %g %g "
                    "%g, length %g)",
                    atom->tag[i], kQuaternionTolerance, q.w, q.x, q.y, q.z, size);
    sc::store(sc::normalized(q), quaternion);
  } else if (keyword == "quat/random") {
    // By the rod's place, as LIGGGHTS does: the same on any number of ranks.
    const double seed = value(0);
    if (!(seed >= 1.0) || seed != std::floor(seed) || seed > INT_MAX)
      rod_error_one(lmp, "Command set: quat/random wants a seed, an integer > 0 (got %g)", seed);
    RanPark random(lmp, "12345787");
    random.reset(static_cast<int>(seed), atom->x[i]);
    const double s = random.uniform();
    const double a = 2.0 * sc::pi * random.uniform(), b = 2.0 * sc::pi * random.uniform();
    sc::store(sc::Quaternion{std::cos(b) * std::sqrt(s), std::sin(a) * std::sqrt(1.0 - s),
                             std::cos(a) * std::sqrt(1.0 - s), std::sin(b) * std::sqrt(s)},
              quaternion);
  }
}

void SetSpherocylinder::report(const Setting &setting, const std::vector<int> &chosen) const
{
  const bigint local = static_cast<bigint>(chosen.size());
  bigint count = 0;
  MPI_Allreduce(&local, &count, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (comm->me != 0) return;
  for (FILE *file : {screen, logfile})
    if (file)
      fprintf(file, "  " BIGINT_FORMAT " settings made for %s\n", count, setting.keyword.c_str());
}
