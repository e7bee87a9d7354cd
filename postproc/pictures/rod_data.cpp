// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/rod_data.h"

#include <algorithm>
#include <array>
#include <string>

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include "core/numbers.h"
#include "measures/fibre_measures.h"
#include "measures/rod_quantity.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {
namespace {

// One value per entry of `rod_of`: that of the rod the cell or point belongs to.
template <class Array, class Value>
void add_numbers(vtkFieldData *data, const std::vector<vtkIdType> &rod_of, const std::string &name,
                 Value value)
{
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(rod_of.size()));
  for (std::size_t i = 0; i < rod_of.size(); i++)
    array->SetValue(static_cast<vtkIdType>(i),
                    static_cast<typename Array::ValueType>(value(rod_of[i])));
  data->AddArray(array);
}

void add_axes(vtkFieldData *data, const std::vector<vtkIdType> &rod_of,
              const std::vector<Rod> &rods)
{
  vtkNew<vtkFloatArray> array;
  array->SetName("axis");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(rod_of.size()));
  for (std::size_t i = 0; i < rod_of.size(); i++) {
    const Vec3 &u = rods[rod_of[i]].capsule.segment.axis;
    array->SetTuple3(static_cast<vtkIdType>(i), u.x, u.y, u.z);
  }
  data->AddArray(array);
}

}  // namespace

std::vector<std::size_t> other_columns(const DumpFrame &frame, const std::vector<std::string> &said)
{
  const std::array rod{"id",    "type",  "shapex", "shapey", "shapez",
                       "quat1", "quat2", "quat3",  "quat4"};
  std::vector<std::size_t> others;
  for (std::size_t column = 0; column < frame.columns.size(); column++) {
    const std::string &name = frame.columns[column];
    if (std::find(rod.begin(), rod.end(), name) == rod.end() &&
        std::find(said.begin(), said.end(), name) == said.end())
      others.push_back(column);
  }
  return others;
}

void attach_rod_data(const RodGeometry &geometry, const DumpFrame &frame,
                     const std::vector<Rod> &rods, const Fibres &fibres)
{
  vtkCellData *cells = geometry.mesh->GetCellData();
  const auto &rod_of = geometry.rod_of_cell;
  const auto add = [&](const std::string &name, auto value) {
    add_numbers<vtkFloatArray>(cells, rod_of, name, value);
  };
  add_numbers<vtkTypeInt64Array>(cells, rod_of, "id", [&](vtkIdType i) { return rods[i].id; });
  add_numbers<vtkTypeInt64Array>(cells, rod_of, "type", [&](vtkIdType i) { return rods[i].type; });
  add("elevation_deg",
      [&](vtkIdType i) { return elevation(rods[i].capsule.segment.axis) * degrees; });
  add("length", [&](vtkIdType i) { return rods[i].capsule.length(); });
  add("diameter", [&](vtkIdType i) { return 2.0 * rods[i].capsule.radius; });
  add_axes(cells, rod_of, rods);

  const std::vector<double> speed = magnitudes(frame, "vx", "vy", "vz");
  const std::vector<double> omega = magnitudes(frame, "omegax", "omegay", "omegaz");
  if (!speed.empty()) add("speed", [&](vtkIdType i) { return speed[i]; });
  if (!omega.empty()) add("omega", [&](vtkIdType i) { return omega[i]; });

  if (fibres.are_there()) {
    const std::vector<double> ids = fibre_ids(fibres), places = fibre_places(fibres);
    const std::vector<double> curvatures = rod_curvatures(rods, fibres);
    add_numbers<vtkTypeInt64Array>(cells, rod_of, "fibre", [&](vtkIdType i) { return ids[i]; });
    add_numbers<vtkTypeInt64Array>(cells, rod_of, "place", [&](vtkIdType i) { return places[i]; });
    add("curvature", [&](vtkIdType i) { return curvatures[i]; });
  }
  for (const std::size_t column : other_columns(frame)) {
    const std::string &name = frame.columns[column];
    if (!cells->HasArray(name.c_str()))
      add(name, [&](vtkIdType i) { return frame.value(static_cast<std::size_t>(i), column); });
  }
  add_numbers<vtkFloatArray>(geometry.mesh->GetPointData(), geometry.rod_of_point, "radius",
                             [&](vtkIdType i) { return rods[i].capsule.radius; });
}

}  // namespace spherocylinder
