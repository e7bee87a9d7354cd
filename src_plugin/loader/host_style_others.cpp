// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_style_rows.h"

namespace spherocylinder {

namespace {

constexpr Verdict kRight = Verdict::Right;
constexpr Verdict kDifferent = Verdict::Different;
constexpr Verdict kRefused = Verdict::Refused;

struct Row {
  const char *name;
  Verdict verdict;
  const char *sentence;
};

void add(std::vector<HostStyle> &rows, HostKind kind, const std::vector<Row> &more)
{
  for (const Row &row : more) rows.push_back({kind, row.name, row.verdict, row.sentence});
}

constexpr const char *kGranOnly = "it does not know rods; use pair_style gran with surface "
                                  "spherocylinder";
constexpr const char *kNoRods = "no rods: LIGGGHTS alone";
constexpr const char *kInconsistent =
    "its force, mass and time do not fit together; use units si, cgs or lj";
constexpr const char *kDrawsSpheres =
    "it draws each rod as its bounding sphere; use dump custom and rod_render or rod_vtk";
constexpr const char *kCentre = "a rod is in it if its centre is";
constexpr const char *kInnerWalls = "see fix wall/gran";
constexpr const char *kTouching =
    "rods would touch as their bounding spheres; use surface spherocylinder";
constexpr const char *kVirtualSpheres =
    "two spheres of the rods' radius at the closest points, mass as felt there";
constexpr const char *kCapillary =
    "its liquid is spread over spheres and acts across a gap; use cohesion off, sjkr or sjkr2";
constexpr const char *kMoves = "moves the mesh";
constexpr const char *kNoBonds = "atom_style spherocylinder has no bonds; leave it out";
constexpr const char *kCoupling =
    "it hands over the bounding sphere's radius as the particle's; leave it out";

void add_scene(std::vector<HostStyle> &rows)
{
  add(rows, HostKind::Pair,
      {{"bubble", kRefused, kGranOnly},
       {"gran", kRight, "with surface spherocylinder"},
       {"gran_bubble", kRefused, kGranOnly},
       {"hybrid", kRefused, kGranOnly},
       {"hybrid/overlay", kRefused, kGranOnly},
       {"line/lj", kRefused, kGranOnly},
       {"none", kDifferent, "rods move and do not touch"},
       {"soft", kRefused, kGranOnly},
       {"sph/artVisc/tensCorr", kRefused, kGranOnly}});
  add(rows, HostKind::AtomStyle,
      {{"atomic", kRight, kNoRods},
       {"charge", kRight, kNoRods},
       {"ellipsoid", kRight, kNoRods},
       {"full", kRight, kNoRods},
       {"granular", kRight, kNoRods},
       {"granular_superquadric", kRight, "not in Debian's library"},
       {"hybrid", kRefused,
        "rods cannot be part of another style; use atom_style spherocylinder alone (a "
        "sphere is a rod with length = diameter)"},
       {"line", kRight, kNoRods},
       {"molecular", kRight, kNoRods},
       {"sph", kRight, kNoRods},
       {"sph/var", kRight, kNoRods},
       {"sphere", kRight, kNoRods},
       {"superquadric", kRight, "not in Debian's library"},
       {"tri", kRight, kNoRods}});
  add(rows, HostKind::Units,
      {{"cgs", kRight, ""},
       {"electron", kRefused, kInconsistent},
       {"lj", kRight, ""},
       {"metal", kRefused, kInconsistent},
       {"micro", kRight, ""},
       {"nano", kRight, ""},
       {"real", kRefused, kInconsistent},
       {"si", kRight, ""}});
  add(rows, HostKind::Box,
      {{"boundary f", kRight, ""},
       {"boundary m", kRight, "shrinks on the rods' centres, not their ends"},
       {"boundary p", kRight, "longer than the longest rod"},
       {"boundary s", kRight, "shrinks on the rods' centres, not their ends"},
       {"dimension 2", kRefused,
        "a rod in a plane would need its axis kept there; use dimension 3"},
       {"orthogonal", kRight, ""},
       {"triclinic", kRefused,
        "contacts across its tilted faces would be missed; use an orthogonal "
        "box"}});
  add(rows, HostKind::Integrate,
      {{"respa", kRefused, "rods are integrated with one time step; use run_style verlet"},
       {"verlet", kRight, ""}});
  add(rows, HostKind::Minimize,
      {{"cg", kRefused,
        "rods have no energy minimiser; let them settle with fix "
        "nve/spherocylinder"}});
  add(rows, HostKind::Molecular,
      {{"angle hybrid", kRefused, kNoBonds},
       {"bond harmonic", kRefused, kNoBonds},
       {"bond hybrid", kRefused, kNoBonds},
       {"dihedral hybrid", kRefused, kNoBonds},
       {"improper hybrid", kRefused, kNoBonds}});
  add(rows, HostKind::CfdCoupling, {{"file", kRefused, kCoupling}, {"mpi", kRefused, kCoupling}});
}

void add_places_and_files(std::vector<HostStyle> &rows)
{
  add(rows, HostKind::Dump,
      {{"atom/vtk", kRefused, kDrawsSpheres},
       {"custom", kDifferent,
        "columns for rods: see atom_style spherocylinder; diameter is the rod's own, "
        "radius the bounding radius, half its length"},
       {"custom/vtk", kDifferent,
        "a rod is a point; write shapex, shapez and quat1 to quat4 to draw it, "
        "or use rod_vtk; its diameter is the rod's length"},
       {"custom/vtm", kDifferent,
        "a rod is a point; write shapex, shapez and quat1 to quat4 to draw it, "
        "or use rod_vtk; its diameter is the rod's length"},
       {"decomposition/vtk", kRight, ""},
       {"euler/vtk", kRefused,
        "it needs fix ave/euler, which takes a rod's volume for its bounding "
        "sphere's; use fix ave/spatial"},
       {"image", kRefused, kDrawsSpheres},
       {"local", kRight, ""},
       {"local/gran/vtk", kRight, "of compute pair/gran/local"},
       {"mesh/gran/VTK", kRight, ""},
       {"mesh/stl", kRight, ""},
       {"mesh/vtk", kRight, ""},
       {"mesh/vtm", kRight, ""},
       {"movie", kRefused, kDrawsSpheres},
       {"stl", kRight, ""},
       {"xyz", kDifferent, "centres only; no axes to read back"}});
  add(rows, HostKind::Region,
      {{"block", kRight, kCentre},
       {"cone", kRight, kCentre},
       {"cylinder", kRight, kCentre},
       {"intersect", kRight, kCentre},
       {"mesh/tet", kRight, kCentre},
       {"plane", kRight, kCentre},
       {"prism", kDifferent,
        "a rod is in it if its centre is; create_box with it makes a triclinic "
        "box, which is refused"},
       {"sphere", kRight, kCentre},
       {"union", kRight, kCentre},
       {"wedge", kRight, kCentre}});
  add(rows, HostKind::Reader,
      {{"native", kRefused,
        "read_dump moves the centres and not the axes; use read_restart or "
        "read_data"},
       {"xyz", kRefused, "it has no axes; use read_restart or read_data"}});
  add(rows, HostKind::Insertion,
      {{"all_in", kDifferent,
        "yes: the bounding sphere in the region; for the rod itself use the "
        "template's all_in_region"},
       {"check_dist_from_subdomain_border", kDifferent,
        "no: on one processor without periodic "
        "boundaries only"},
       {"compress_tags", kRefused,
        "it gives rods new ids that contact histories do not know; leave "
        "it out"},
       {"distributiontemplate", kRight, ""},
       {"duration", kRight, ""},
       {"duration_time", kRight, ""},
       {"extrude_length", kRight, ""},
       {"insert_every", kRight, ""},
       {"insert_every_time", kRight, ""},
       {"insertion_face", kRight, ""},
       {"mass", kRight, ""},
       {"mass_in_region", kRight, ""},
       {"massrate", kRight, ""},
       {"maxattempt", kRight, ""},
       {"nparticles", kRight, ""},
       {"ntry_mc", kRight, ""},
       {"omega", kRight, "insert/stream: from the release on"},
       {"orientation", kRight, "a quaternion of length 1 to within 0.001 is normalised"},
       {"overlapcheck", kRight, "rods against rods"},
       {"parallel", kRight, ""},
       {"particlerate", kRight, ""},
       {"particles_in_region", kRight, ""},
       {"random_distribute", kRight, ""},
       {"region", kRight, ""},
       {"save_template", kRight, ""},
       {"seed", kRight, ""},
       {"set_property", kRight, ""},
       {"start", kRight, ""},
       {"vel", kRight, ""},
       {"verbose", kRight, ""},
       {"volumefraction_region", kRight, "of the rods' own volume"},
       {"warn_region", kRight, ""}});
}

void add_contacts(std::vector<HostStyle> &rows)
{
  add(rows, HostKind::WallPrimitive,
      {{"xcylinder", kRight, kInnerWalls},
       {"xplane", kRight, kInnerWalls},
       {"ycylinder", kRight, kInnerWalls},
       {"yplane", kRight, kInnerWalls},
       {"zcylinder", kRight, kInnerWalls},
       {"zplane", kRight, kInnerWalls}});
  add(rows, HostKind::Surface,
      {{"default", kRefused, kTouching},
       {"multicontact", kRefused, kTouching},
       {"superquadric", kRefused, kTouching}});
  add(rows, HostKind::Normal,
      {{"edinburgh", kRight, kVirtualSpheres},
       {"edinburgh/stiffness", kRight, kVirtualSpheres},
       {"hertz", kRight, kVirtualSpheres},
       {"hertz/stiffness", kRight, kVirtualSpheres},
       {"hooke", kRight, kVirtualSpheres},
       {"hooke/hysteresis", kRight, kVirtualSpheres},
       {"hooke/stiffness", kRight, kVirtualSpheres},
       {"luding", kRight, kVirtualSpheres},
       {"thornton_ning", kRight, kVirtualSpheres}});
  add(rows, HostKind::Tangential,
      {{"history", kRight, ""}, {"no_history", kRight, ""}, {"tan_luding", kRight, ""}});
  add(rows, HostKind::Cohesion,
      {{"easo/capillary/viscous", kRefused, kCapillary},
       {"sjkr", kRight, kVirtualSpheres},
       {"sjkr2", kRight, kVirtualSpheres},
       {"washino/capillary/viscous", kRefused, kCapillary}});
  add(rows, HostKind::Rolling,
      {{"cdt", kRight, kVirtualSpheres},
       {"epsd", kDifferent,
        "its damping takes the inertia of a sphere of the rod's mass and radius"},
       {"epsd2", kDifferent,
        "its stiffness takes the inertia of a sphere of the rod's mass and "
        "radius"},
       {"epsd3", kDifferent,
        "its damping takes the inertia of a sphere of the rod's mass and "
        "radius"},
       {"luding", kRight, kVirtualSpheres}});
  add(rows, HostKind::MeshModule,
      {{"liquidtransfer", kRefused, "its liquid is spread over spheres; leave it out"},
       {"servo", kRight, "with fix wall/gran mesh"},
       {"stress", kRight,
        "with fix wall/gran mesh: at the contacts' points, wear by the rods' velocity there"}});
  add(rows, HostKind::MeshMover,
      {{"linear", kRight, kMoves},
       {"linear/variable", kRight, kMoves},
       {"riggle", kRight, kMoves},
       {"rotate", kRight, kMoves},
       {"rotate/variable", kRight, kMoves},
       {"viblin", kRight, kMoves},
       {"vibrot", kRight, kMoves},
       {"wiggle", kRight, kMoves}});
}

}  // namespace

std::vector<HostStyle> other_rows()
{
  std::vector<HostStyle> rows;
  add_scene(rows);
  add_places_and_files(rows);
  add_contacts(rows);
  return rows;
}

}  // namespace spherocylinder
