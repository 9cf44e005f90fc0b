// SPDX-License-Identifier: Apache-2.0
#include "vtk_clip.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVersion.h>

#include <cstdlib>

#include "report.h"

namespace incise::bench {

class VtkClip::Impl {
 public:
  explicit Impl(const TetSoup& soup) {
    setenv("VTK_SMP_MAX_THREADS", "1", 1);  // its own header for this is no C++20
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(soup.points.size()));
    for (std::size_t i = 0; i < soup.points.size(); ++i) {
      points->SetPoint(static_cast<vtkIdType>(i), soup.points[i].data());
    }
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(static_cast<vtkIdType>(soup.tets.size()), static_cast<vtkIdType>(4 * soup.tets.size()));
    for (const auto& tet : soup.tets) {
      cells->InsertNextCell({tet[0], tet[1], tet[2], tet[3]});
    }
    grid_->SetPoints(points);
    grid_->SetCells(VTK_TETRA, cells);
  }

  double run_ms(const Vec3& normal, double offset, bool keeps_both) {
    const Vec3 unit = normal.normalized();
    const Vec3 origin = (offset / normal.norm()) * unit;
    vtkNew<vtkPlane> plane;
    plane->SetNormal(unit.x(), unit.y(), unit.z());
    plane->SetOrigin(origin.x(), origin.y(), origin.z());
    vtkNew<vtkTableBasedClipDataSet> clip;
    clip->SetInputData(grid_);
    clip->SetClipFunction(plane);
    clip->SetGenerateClippedOutput(keeps_both);
    const double start = thread_ms();
    clip->Update();
    const double elapsed = thread_ms() - start;
    cells_ = static_cast<std::uint64_t>(clip->GetOutput()->GetNumberOfCells());
    if (keeps_both) {
      cells_ += static_cast<std::uint64_t>(clip->GetClippedOutput()->GetNumberOfCells());
    }
    return elapsed;
  }
  [[nodiscard]] std::uint64_t output_cells() const { return cells_; }

 private:
  vtkNew<vtkUnstructuredGrid> grid_;
  std::uint64_t cells_ = 0;
};

VtkClip::VtkClip(const TetSoup& soup) : impl_(std::make_unique<Impl>(soup)) {}
VtkClip::VtkClip(VtkClip&&) noexcept = default;
VtkClip::~VtkClip() = default;

double VtkClip::run_ms(const Vec3& normal, double offset, bool keeps_both) {
  return impl_->run_ms(normal, offset, keeps_both);
}
std::uint64_t VtkClip::output_cells() const {
  return impl_->output_cells();
}
std::string VtkClip::version() {
  return vtkVersion::GetVTKVersion();
}

}  // namespace incise::bench
