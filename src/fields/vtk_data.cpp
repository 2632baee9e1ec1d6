#include "fields/vtk_data.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkUnsignedIntArray.h>

#include <algorithm>
#include <array>
#include <string>

#include "monarch_flight/insect/insect.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// North-east-down components to those of `world` (x east, y north, z up).
Matrix3d worldAxes() {
  Matrix3d R;
  R << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  return R;
}

vtkSmartPointer<vtkFloatArray> array(const char* name, int components, std::size_t tuples) {
  auto a = vtkSmartPointer<vtkFloatArray>::New();
  a->SetName(name);
  a->SetNumberOfComponents(components);
  a->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return a;
}

void putVector(vtkFloatArray* a, vtkIdType i, const Vector3d& v) {
  a->SetTuple3(i, v.x(), v.y(), v.z());
}

/// ParaView takes the time from TimeValue; the body's position is the head of the flown path, and
/// Q_threshold an iso-value that shows the vortices of the edges.
void addRunData(double q_threshold, const CommittedStep& step, vtkDataObject* data) {
  auto time = vtkSmartPointer<vtkDoubleArray>::New();
  time->SetName("TimeValue");
  time->InsertNextValue(step.t);
  auto number = vtkSmartPointer<vtkUnsignedIntArray>::New();
  number->SetName("step");
  number->InsertNextValue(step.step);
  auto body = vtkSmartPointer<vtkDoubleArray>::New();
  body->SetName("body");
  body->SetNumberOfComponents(3);
  const Vector3d x = worldAxes() * step.interface.body.x;
  body->InsertNextTuple3(x.x(), x.y(), x.z());
  auto threshold = vtkSmartPointer<vtkDoubleArray>::New();
  threshold->SetName("Q_threshold");
  threshold->InsertNextValue(q_threshold);
  for (vtkDataArray* a :
       {static_cast<vtkDataArray*>(time.Get()), static_cast<vtkDataArray*>(threshold.Get()),
        static_cast<vtkDataArray*>(number.Get()), static_cast<vtkDataArray*>(body.Get())}) {
    data->GetFieldData()->AddArray(a);
  }
}

/// Puts a wing's points and vectors into the world; the left one is told in the mirror (state.h).
class Placement {
 public:
  Placement(const Case& c, const CommittedStep& step, Side side)
      : motion_(wingMotion(side, c.insect, step.interface.body, step.angles)),
        across_(side == Side::kRight ? 1.0 : -1.0) {}
  Vector3d point(const Vector3d& r_W) const { return out(motion_.r_I + motion_.R_IW * r_W); }
  Vector3d vector(const Vector3d& v_W) const { return out(motion_.R_IW * v_W); }
  /// Vorticity turns the other way round in a mirror.
  Vector3d axial(const Vector3d& w_W) const { return across_ * vector(w_W); }

 private:
  Vector3d out(const Vector3d& v_I) const {
    return worldAxes() * Vector3d(v_I.x(), across_ * v_I.y(), v_I.z());
  }
  WingMotion motion_;
  double across_;
};

/// The arrays of the wing's surface, all faces of one wing after the other.
struct SurfaceArrays {
  vtkSmartPointer<vtkFloatArray> pressure_dorsal, pressure_ventral, jump, cp_dorsal, cp_ventral,
      cp_jump, friction_dorsal, friction_ventral, normal;

  explicit SurfaceArrays(std::size_t faces)
      : pressure_dorsal(array("pressure_dorsal", 1, faces)),
        pressure_ventral(array("pressure_ventral", 1, faces)),
        jump(array("pressure_jump", 1, faces)),
        cp_dorsal(array("Cp_dorsal", 1, faces)),
        cp_ventral(array("Cp_ventral", 1, faces)),
        cp_jump(array("Cp_jump", 1, faces)),
        friction_dorsal(array("friction_dorsal", 3, faces)),
        friction_ventral(array("friction_ventral", 3, faces)),
        normal(array("normal", 3, faces)) {}

  void put(vtkIdType i, const FlowField::WingFace& f, const Placement& place, double dynamic) {
    const double jump_value = double(f.p_upper) - f.p_lower;  // pushes the wing along +z
    pressure_dorsal->SetValue(i, f.p_upper);
    pressure_ventral->SetValue(i, f.p_lower);
    jump->SetValue(i, float(jump_value));
    cp_dorsal->SetValue(i, float(f.p_upper / dynamic));
    cp_ventral->SetValue(i, float(f.p_lower / dynamic));
    cp_jump->SetValue(i, float(jump_value / dynamic));
    putVector(friction_dorsal, i, place.vector({f.friction_upper[0], f.friction_upper[1], 0}));
    putVector(friction_ventral, i, place.vector({f.friction_lower[0], f.friction_lower[1], 0}));
    putVector(normal, i, place.vector(Vector3d::UnitZ()));
  }
  void addTo(vtkCellData* data) {
    for (vtkFloatArray* a : {pressure_dorsal.Get(), pressure_ventral.Get(), jump.Get(),
                             cp_dorsal.Get(), cp_ventral.Get(), cp_jump.Get(),
                             friction_dorsal.Get(), friction_ventral.Get(), normal.Get()}) {
      data->AddArray(a);
    }
  }
};

}  // namespace

vtkSmartPointer<vtkStructuredGrid> flowGrid(const Case& c, const FieldScales& scales,
                                            const CommittedStep& step, Side side) {
  const FlowField& flow = *step.flow[side];
  const Placement place(c, step, side);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();  // single precision is coarse beside the first cell after a metre
  const std::size_t corners = flow.x.size() * flow.y.size() * flow.z.size();
  points->Allocate(static_cast<vtkIdType>(corners));
  for (double z : flow.z) {
    for (double y : flow.y) {
      for (double x : flow.x) points->InsertNextPoint(place.point({x, y, z}).data());
    }
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(static_cast<int>(flow.x.size()), static_cast<int>(flow.y.size()),
                      static_cast<int>(flow.z.size()));
  grid->SetPoints(points);

  const std::size_t n = flow.cells();
  auto velocity = array("velocity", 3, n), vorticity = array("vorticity", 3, n);
  auto spanwise = array("spanwise_vorticity", 1, n), pressure = array("pressure", 1, n);
  auto q = array("Q", 1, n);
  const Vector3d wind = worldAxes() * step.guided.wind.v;
  for (std::size_t i = 0; i < n; ++i) {
    const vtkIdType id = static_cast<vtkIdType>(i);
    const Vector3d v = Eigen::Map<const Eigen::Vector3f>(&flow.velocity[3 * i]).cast<double>();
    const Vector3d w = Eigen::Map<const Eigen::Vector3f>(&flow.vorticity[3 * i]).cast<double>();
    putVector(velocity, id, place.vector(v) + wind);
    putVector(vorticity, id, place.axial(w));
    spanwise->SetValue(id, flow.vorticity[3 * i + 1]);
    pressure->SetValue(id, flow.pressure[i]);
    q->SetValue(id, flow.q[i]);
  }
  for (vtkFloatArray* a :
       {velocity.Get(), vorticity.Get(), spanwise.Get(), pressure.Get(), q.Get()}) {
    grid->GetCellData()->AddArray(a);
  }
  addRunData(scales.q_threshold, step, grid);
  return grid;
}

vtkSmartPointer<vtkPolyData> wingSurface(const Case& c, const FieldScales& scales,
                                         const CommittedStep& step) {
  const Sides sides{c.insect.bare_wing ? 1U : 2U};
  std::size_t faces = 0;
  for (Side side : sides) faces += step.flow[side]->wing.size();
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  SurfaceArrays arrays(faces);
  vtkIdType id = 0;
  for (Side side : sides) {
    const Placement place(c, step, side);
    for (const FlowField::WingFace& f : step.flow[side]->wing) {
      std::array<vtkIdType, 4> corner;
      for (int q = 0; q < 4; ++q) {
        const double x = f.x + (q == 1 || q == 2 ? 0.5 : -0.5) * f.dx;
        const double y = f.y + (q >= 2 ? 0.5 : -0.5) * f.dy;
        corner[static_cast<std::size_t>(q)] =
            points->InsertNextPoint(place.point({x, y, 0}).data());
      }
      if (side == Side::kLeft) std::reverse(corner.begin(), corner.end());
      cells->InsertNextCell(4, corner.data());
      arrays.put(id++, f, place, scales.pressure.dynamic);
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  arrays.addTo(surface->GetCellData());
  addRunData(scales.q_threshold, step, surface);
  return surface;
}

}  // namespace monarch_flight
