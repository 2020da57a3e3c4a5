// SPDX-License-Identifier: MIT
// What VTK's own readers, and so ParaView, find in the files.
#include "output/vtk.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>

using namespace tribo;

namespace {

template <class Reader>
auto* read(Reader& reader, const std::filesystem::path& file) {
  reader->SetFileName(file.c_str());
  reader->Update();
  REQUIRE(reader->GetErrorCode() == 0);
  return reader->GetOutput();
}

}  // namespace

TEST_CASE("VTK reads particles of several blocks of data, packed or stored", "[output]") {
  const ScratchFolder scratch;
  const std::size_t n = 70000;  // more than a block of every array
  std::vector<double> random(n), even(n), zero(n, 0.0);
  std::vector<std::int64_t> id(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<double>(i);
    random[i] = std::sin(k * k), even[i] = k, id[i] = static_cast<std::int64_t>(n - i);
  }
  const std::vector<OutputField> fields{
      {"velocity", {random.data(), nullptr, even.data()}},
      {"id", {}, id.data()},
      {"stress", {random.data(), even.data(), random.data(), zero.data(), zero.data(), random.data()}},
      {"small", {random.data()}, nullptr, true}};
  for (int again = 0; again < 2; ++again) {
    const auto file = scratch.path / "p.vtp";
    write_particles(file, n, {even.data(), random.data(), nullptr}, fields, 0.25);
    vtkNew<vtkXMLPolyDataReader> reader;
    auto* data = read(reader, file);
    REQUIRE(data->GetNumberOfPoints() == static_cast<vtkIdType>(n));
    REQUIRE(data->GetVerts()->GetNumberOfCells() == static_cast<vtkIdType>(n));
    CHECK(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 0.25);
    auto* points = data->GetPointData();
    auto *velocity = points->GetArray("velocity"), *stress = points->GetArray("stress");
    CHECK(std::string(stress->GetComponentName(5)) == "XZ");
    CHECK(points->GetArray("small")->GetDataType() == VTK_FLOAT);
    bool same = true;
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = static_cast<vtkIdType>(i);
      const double* x = data->GetPoint(at);
      same = same && x[0] == even[i] && x[1] == random[i] && x[2] == 0;
      same = same && velocity->GetComponent(at, 0) == random[i] && velocity->GetComponent(at, 1) == 0 &&
             velocity->GetComponent(at, 2) == even[i];
      same = same && stress->GetComponent(at, 1) == even[i] && stress->GetComponent(at, 5) == random[i];
      same = same && points->GetArray("id")->GetComponent(at, 0) == static_cast<double>(id[i]);
      same =
          same && points->GetArray("small")->GetComponent(at, 0) == static_cast<double>(static_cast<float>(random[i]));
      vtkIdType size = 0;
      const vtkIdType* corner = nullptr;
      data->GetVerts()->GetCellAtId(at, size, corner);
      same = same && size == 1 && *corner == at;
    }
    CHECK(same);
  }
}

TEST_CASE("VTK reads cells with their fields and texts", "[output]") {
  const ScratchFolder scratch;
  const std::vector<double> x{0, 1, 1, 0, 2}, y{0, 0, 1, 1, 0}, value{5, 6};
  const std::vector<std::uint32_t> cells{0, 1, 2, 3, 1, 4, 2};
  const std::vector<std::size_t> ends{4, 7};
  const std::vector<std::string> words{"bonded", "<open>"};
  OutputField texts{"state_text", {}};
  texts.texts = words.data();
  const auto file = scratch.path / "c.vtp";
  write_cells(file, 5, {x.data(), y.data(), nullptr}, cells, ends,
              std::vector{OutputField{"a<b", {value.data()}}, texts}, 1.0);
  vtkNew<vtkXMLPolyDataReader> reader;
  auto* data = read(reader, file);
  REQUIRE(data->GetPolys()->GetNumberOfCells() == 2);
  CHECK(data->GetLines()->GetNumberOfCells() == 0);
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  data->GetPolys()->GetCellAtId(1, size, corners);
  REQUIRE(size == 3);
  CHECK((corners[0] == 1 && corners[1] == 4 && corners[2] == 2));
  CHECK(data->GetCellData()->GetArray("a<b")->GetComponent(1, 0) == 6);
  auto* read_words = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("state_text"));
  REQUIRE(read_words);
  CHECK((read_words->GetValue(0) == "bonded" && read_words->GetValue(1) == "<open>"));

  const std::vector<std::uint32_t> lines{0, 1, 1, 4};
  write_surface(file, 5, {x.data(), y.data(), nullptr}, lines, 2, std::vector{OutputField{"gap", {x.data()}}}, 1.0);
  vtkNew<vtkXMLPolyDataReader> again;
  data = read(again, file);
  CHECK(data->GetLines()->GetNumberOfCells() == 2);
  CHECK(data->GetPointData()->GetArray("gap")->GetComponent(4, 0) == 2);
  write_particles(file, 0, {nullptr, nullptr, nullptr}, {}, 0.0);
  vtkNew<vtkXMLPolyDataReader> empty;
  CHECK(read(empty, file)->GetNumberOfPoints() == 0);
}

TEST_CASE("VTK reads a grid", "[output]") {
  const ScratchFolder scratch;
  std::vector<double> mass(12);
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = 0.1 * static_cast<double>(i);
  const auto file = scratch.path / "g.vti";
  write_grid(file, {-1, 2, 0.5}, {0.5, 0.25, 1}, {4, 3, 1}, std::vector{OutputField{"mass", {mass.data()}}}, 3.0);
  vtkNew<vtkXMLImageDataReader> reader;
  auto* data = read(reader, file);
  CHECK((data->GetDimensions()[0] == 4 && data->GetDimensions()[1] == 3 && data->GetDimensions()[2] == 1));
  CHECK((data->GetOrigin()[0] == -1 && data->GetOrigin()[2] == 0.5 && data->GetSpacing()[1] == 0.25));
  CHECK(data->GetPointData()->GetArray("mass")->GetComponent(11, 0) == mass[11]);
}
