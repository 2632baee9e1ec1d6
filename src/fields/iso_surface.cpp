#include "monarch_flight/fields/iso_surface.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

namespace monarch_flight {
namespace {

/// A field of the picture as numbers [1/s], half of each from its neighbours along each axis: the
/// numbers of the grid would make lumps.
std::vector<float> softened(const FlowPicture& picture, const std::vector<std::int16_t>& whole) {
  std::vector<float> values;
  for (std::int16_t number : whole) values.push_back(picture.step * static_cast<float>(number));
  std::size_t stride = 1;
  for (std::size_t n : picture.size) {
    const std::vector<float> before = values;
    for (std::size_t at = 0; at < values.size(); ++at) {
      const std::size_t i = at / stride % n;
      const float low = before[i > 0 ? at - stride : at];
      const float high = before[i + 1 < n ? at + stride : at];
      values[at] = 0.5f * before[at] + 0.25f * (low + high);
    }
    stride *= n;
  }
  return values;
}

/// Fades to 0 at the block's rim, so that a vortex that leaves the block has a closed end.
std::vector<float> faded(const FlowPicture& picture, std::vector<float> values) {
  constexpr std::size_t kFade = 2;  // points
  for (std::size_t at = 0; at < values.size(); ++at) {
    std::size_t rest = at, inside = kFade;
    for (std::size_t n : picture.size) {
      if (n > 4 * kFade) inside = std::min({inside, rest % n, n - 1 - rest % n});
      rest /= n;
    }
    values[at] *= static_cast<float>(inside) / kFade;
  }
  return values;
}

vtkSmartPointer<vtkFloatArray> floats(const char* name, const std::vector<float>& values) {
  auto out = vtkSmartPointer<vtkFloatArray>::New();
  out->SetName(name);
  out->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), out->GetPointer(0));
  return out;
}

vtkSmartPointer<vtkImageData> imageOf(const FlowPicture& picture) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  const auto n = [&picture](std::size_t d) { return static_cast<int>(picture.size[d]); };
  image->SetDimensions(n(0), n(1), n(2));
  image->SetOrigin(picture.origin[0], picture.origin[1], picture.origin[2]);
  image->SetSpacing(picture.spacing, picture.spacing, picture.spacing);
  image->GetPointData()->SetScalars(
      floats("q_root", faded(picture, softened(picture, picture.q_root))));
  image->GetPointData()->AddArray(floats("omega_y", softened(picture, picture.omega_y)));
  return image;
}

Eigen::Vector3f vectorAt(const double* p) {
  return Eigen::Vector3d(p[0], p[1], p[2]).cast<float>();
}

IsoSurface surfaceOf(vtkPolyData* found) {
  IsoSurface out;
  vtkDataArray* normals = found->GetPointData()->GetNormals();
  vtkDataArray* omega = found->GetPointData()->GetArray("omega_y");
  for (vtkIdType i = 0; i < found->GetNumberOfPoints(); ++i) {
    out.points.push_back(vectorAt(found->GetPoint(i)));
    out.normals.push_back(vectorAt(normals->GetTuple(i)));
    out.omega_y.push_back(static_cast<float>(omega->GetTuple1(i)));
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray* triangles = found->GetPolys();
  for (triangles->InitTraversal(); triangles->GetNextCell(corners);) {
    const auto corner = [&corners](vtkIdType i) {
      return static_cast<std::uint32_t>(corners->GetId(i));
    };
    out.triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return out;
}

/// Every second point along each axis.
FlowPicture coarser(const FlowPicture& picture) {
  FlowPicture out = picture;
  out.spacing *= 2.0f;
  out.q_root.clear();
  out.omega_y.clear();
  const auto [nx, ny, nz] = picture.size;
  out.size = {(nx + 1) / 2, (ny + 1) / 2, (nz + 1) / 2};
  for (std::size_t k = 0; k < nz; k += 2) {
    for (std::size_t j = 0; j < ny; j += 2) {
      for (std::size_t i = 0; i < nx; i += 2) {
        const std::size_t at = (k * ny + j) * nx + i;
        out.q_root.push_back(picture.q_root[at]);
        out.omega_y.push_back(picture.omega_y[at]);
      }
    }
  }
  return out;
}

}  // namespace

bool hasIsoSurfaces() { return true; }

IsoSurface isoSurface(const FlowPicture& picture, double q, std::size_t most) {
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(imageOf(picture));
  edges->SetValue(0, std::sqrt(q));
  edges->ComputeNormalsOn();
  edges->ComputeScalarsOff();
  edges->InterpolateAttributesOn();
  edges->Update();
  if (static_cast<std::size_t>(edges->GetOutput()->GetNumberOfPolys()) > most)
    return isoSurface(coarser(picture), q, most);
  return surfaceOf(edges->GetOutput());
}

}  // namespace monarch_flight
