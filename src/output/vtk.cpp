// SPDX-License-Identifier: MIT
#include "output/vtk.hpp"

#include "base/finite.hpp"
#include "base/memory.hpp"
#include "base/read_file.hpp"
#include "output/atomic_file.hpp"
#include "output/deflate_compressor.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tribo {
namespace {

[[noreturn]] void refuse(const std::string& name, std::size_t row) {
  throw SimulationError("the field '" + name + "' of row " + std::to_string(row) +
                        " of the results is not a number, and is not written; usually the step is too large: try a "
                        "smaller <TimeFactor>");
}

void check_component(const std::string& name, const double* values, std::size_t count) {
  if (!values || all_finite({values, count})) return;
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) refuse(name, i);
}

void check_numbers_of(const std::string& name, const OutputRows& rows, std::size_t count) {
  const std::size_t width = static_cast<std::size_t>(rows.width), size = count * width;
  if (rows.doubles ? all_finite({rows.doubles, size}) : all_finite({rows.floats, size})) return;
  for (std::size_t i = 0; i < size; ++i)
    if (!std::isfinite(rows.doubles ? rows.doubles[i] : rows.floats[i])) refuse(name, i / width);
}

void name_components(vtkDataArray* array, const std::string& name, int components) {
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  if (components != 6) return;
  int c = 0;
  for (const char* label : {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}) array->SetComponentName(c++, label);
}

// VTK only reads the numbers, and does not free them.
template <class Array, class Number>
vtkSmartPointer<vtkDataArray> array_of(const Number* numbers, vtkIdType size) {
  static constexpr int keep = 1;
  const auto array = vtkSmartPointer<Array>::New();
  array->SetArray(const_cast<Number*>(numbers), size, keep);  // NOLINT(*-const-cast)
  return array;
}

vtkSmartPointer<vtkDataArray> array_of(const std::string& name, const OutputRows& rows, vtkIdType n) {
  check_numbers_of(name, rows, static_cast<std::size_t>(n));
  const vtkIdType size = n * rows.width;
  auto array = rows.doubles ? array_of<vtkDoubleArray>(rows.doubles, size) : array_of<vtkFloatArray>(rows.floats, size);
  name_components(array, name, rows.width);
  return array;
}

vtkSmartPointer<vtkDataArray> array_of_components(const OutputField& field, vtkIdType n) {
  const auto array = vtkSmartPointer<vtkDoubleArray>::New();
  const auto components = static_cast<int>(field.components.size());
  name_components(array, field.name, components);
  array->SetNumberOfTuples(n);
  double* to = array->GetPointer(0);
  for (int c = 0; c < components; ++c) {
    const double* from = field.components[static_cast<std::size_t>(c)];
    check_component(field.name, from, static_cast<std::size_t>(n));
    for (vtkIdType i = 0; i < n; ++i) to[i * components + c] = from ? from[i] : 0.0;
  }
  return array;
}

vtkSmartPointer<vtkDataArray> array_of_integers(const OutputField& field, vtkIdType n) {
  const auto array = vtkSmartPointer<vtkTypeInt64Array>::New();
  array->SetName(field.name.c_str());
  array->SetNumberOfTuples(n);
  std::copy_n(field.integers, n, array->GetPointer(0));
  return array;
}

void add_texts(vtkDataSetAttributes* data, const OutputField& field, vtkIdType n) {
  vtkNew<vtkStringArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfTuples(n);
  for (vtkIdType i = 0; i < n; ++i) array->SetValue(i, field.texts[i]);
  data->AddArray(array);
}

// The array `id` identifies points from file to file, which filters of ParaView for paths and selections use.
void add_fields(vtkDataSetAttributes* data, std::size_t count, std::span<const OutputField> fields) {
  const auto n = static_cast<vtkIdType>(count);
  for (const auto& field : fields) {
    if (field.texts) {
      add_texts(data, field, n);
      continue;
    }
    const bool rows = field.rows.doubles || field.rows.floats;
    const auto array = field.integers ? array_of_integers(field, n)
                       : rows         ? array_of(field.name, field.rows, n)
                                      : array_of_components(field, n);
    if (!field.unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.unit.c_str());
    if (field.integers && field.name == "id")
      data->SetGlobalIds(array);
    else
      data->AddArray(array);
  }
}

void add_time(vtkDataObject* object, double time) {
  vtkNew<vtkDoubleArray> value;
  value->SetName("TimeValue");
  value->InsertNextValue(time);
  object->GetFieldData()->AddArray(value);
}

void add_names(vtkDataObject* object, const char* name, std::span<const std::string> names) {
  if (names.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : names) array->InsertNextValue(text);
  object->GetFieldData()->AddArray(array);
}

// VTK takes no threads of its own beside those of the run; set before any thread starts.
[[maybe_unused]] const bool sequential =
    ::setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0) == 0;  // NOLINT(concurrency-mt-unsafe)

// Throws a FileError if there is not as much memory for a file as this, and some for VTK itself, which ends the program
// if its memory is too small or it can start no thread.
void probe_memory(const std::filesystem::path& path, std::size_t bytes) {
  static constexpr std::size_t working = std::size_t{8} << 20;
  void* volatile probe = std::malloc(bytes + working);  // NOLINT(*-no-malloc)
  if (!probe) refuse_memory("the file '" + printable(path.string()) + "'");
  std::free(probe);  // NOLINT(*-no-malloc)
}

// The same for points with these fields, before VTK has them.
void probe_memory(const std::filesystem::path& path, std::size_t count, std::span<const OutputField> fields) {
  std::size_t numbers = 6;  // position and cell
  for (const OutputField& field : fields)
    if (!field.rows.doubles && !field.rows.floats) numbers += std::max<std::size_t>(1, field.components.size());
  probe_memory(path, count * numbers * sizeof(double));
}

template <class Writer, class Data>
void write(const std::filesystem::path& path, Data* data) {
  probe_memory(path, 2048 * data->GetActualMemorySize());
  write_atomically(path, [&](const std::string& temporary) {
    vtkNew<Writer> writer;
    writer->SetFileName(temporary.c_str());
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressor(vtkNew<DeflateCompressor>());
    return writer->Write() == 1 && writer->GetErrorCode() == 0;
  });
}

}  // namespace

namespace {

void set_points(vtkPolyData* data, std::size_t count, const std::array<const double*, 3>& position) {
  const auto n = static_cast<vtkIdType>(count);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(n);
  for (const double* x : position) check_component("position", x, count);
  for (vtkIdType i = 0; i < n; ++i) {
    points->SetPoint(i, position[0][i], position[1] ? position[1][i] : 0.0, position[2] ? position[2][i] : 0.0);
  }
  data->SetPoints(points);
}

void set_points(vtkPolyData* data, std::size_t count, const OutputRows& position) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(array_of("position", position, static_cast<vtkIdType>(count)));
  points->GetData()->SetName("Points");
  data->SetPoints(points);
}

void write_points(const std::filesystem::path& path, std::size_t count, vtkPolyData* data,
                  std::span<const OutputField> fields, double time, std::span<const std::string> materials = {}) {
  const auto n = static_cast<vtkIdType>(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(n, n);
  for (vtkIdType i = 0; i < n; ++i) vertices->InsertNextCell(1, &i);
  data->SetVerts(vertices);
  add_fields(data->GetPointData(), count, fields);
  add_time(data, time);
  add_names(data, "material names", materials);
  write<vtkXMLPolyDataWriter>(path, data);
}

}  // namespace

void check_numbers(std::size_t count, const std::array<const double*, 3>& position,
                   std::span<const OutputField> fields) {
  for (const double* x : position) check_component("position", x, count);
  for (const OutputField& field : fields)
    for (const double* values : field.components) check_component(field.name, values, count);
}

void check_rows(std::size_t count, const OutputRows& position, std::span<const OutputField> fields) {
  check_numbers_of("position", position, count);
  for (const OutputField& field : fields)
    if (field.rows.doubles || field.rows.floats) check_numbers_of(field.name, field.rows, count);
}

void write_surface(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                   std::span<const std::uint32_t> cells, std::size_t corners, std::span<const OutputField> fields,
                   double time) {
  probe_memory(path, count, fields);
  vtkNew<vtkPolyData> data;
  set_points(data, count, position);
  vtkNew<vtkCellArray> list;
  for (std::size_t at = 0; at < cells.size(); at += corners) {
    list->InsertNextCell(static_cast<int>(corners));
    for (std::size_t k = 0; k < corners; ++k) list->InsertCellPoint(static_cast<vtkIdType>(cells[at + k]));
  }
  if (corners == 2)
    data->SetLines(list);
  else
    data->SetPolys(list);
  add_fields(data->GetPointData(), count, fields);
  add_time(data, time);
  write<vtkXMLPolyDataWriter>(path, data.Get());
}

void write_cells(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                 std::span<const std::uint32_t> cells, std::span<const std::size_t> ends,
                 std::span<const OutputField> fields, double time) {
  probe_memory(path, count, fields);
  vtkNew<vtkPolyData> data;
  set_points(data, count, position);
  vtkNew<vtkCellArray> list;
  std::size_t at = 0;
  bool lines = true;
  for (const std::size_t end : ends) {
    lines = lines && end - at <= 2;
    list->InsertNextCell(static_cast<int>(end - at));
    for (; at < end; ++at) list->InsertCellPoint(static_cast<vtkIdType>(cells[at]));
  }
  if (lines)
    data->SetLines(list);
  else
    data->SetPolys(list);
  add_fields(data->GetCellData(), ends.size(), fields);
  add_time(data, time);
  write<vtkXMLPolyDataWriter>(path, data.Get());
}

void write_particles(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                     std::span<const OutputField> fields, double time) {
  probe_memory(path, count, fields);
  vtkNew<vtkPolyData> data;
  set_points(data, count, position);
  write_points(path, count, data, fields, time);
}

void write_particles(const std::filesystem::path& path, std::size_t count, const OutputRows& position,
                     std::span<const OutputField> fields, double time, std::span<const std::string> materials) {
  probe_memory(path, count, fields);
  vtkNew<vtkPolyData> data;
  set_points(data, count, position);
  write_points(path, count, data, fields, time, materials);
}

void write_grid(const std::filesystem::path& path, const std::array<double, 3>& origin,
                const std::array<double, 3>& spacing, const std::array<int, 3>& nodes,
                std::span<const OutputField> fields, double time) {
  std::size_t count = 1;
  for (const int n : nodes) count *= static_cast<std::size_t>(n);
  probe_memory(path, count, fields);
  vtkNew<vtkImageData> data;
  data->SetOrigin(origin[0], origin[1], origin[2]);
  data->SetSpacing(spacing[0], spacing[1], spacing[2]);
  data->SetDimensions(nodes[0], nodes[1], nodes[2]);
  add_fields(data->GetPointData(), static_cast<std::size_t>(data->GetNumberOfPoints()), fields);
  add_time(data, time);
  write<vtkXMLImageDataWriter>(path, data.Get());
}

}  // namespace tribo
