#include "monarch_flight/fields/field_output.h"

#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLStructuredGridWriter.h>

#include <cstdio>
#include <filesystem>
#include <sstream>
#include <tuple>
#include <vector>

#include "fields/vtk_data.h"
#include "monarch_flight/run/output_file.h"
#include "monarch_flight/run/wing_speeds.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;

/// What a VTK writer makes of a data set, as bytes.
template <class Writer, class Data>
std::string written(const Data& data, const std::string& path) {
  auto writer = vtkSmartPointer<Writer>::New();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw OutputError(path + ": VTK could not make this file");
  return writer->GetOutputString();
}

class FieldOutput : public StepSink {
 public:
  FieldOutput(const Case& c, const std::string& folder, StateVisitor* resumed)
      : case_(c),
        folder_(folder),
        scales_{pressureReference(c), vortexThreshold(c)},
        resumed_(resumed != nullptr) {
    if (resumed != nullptr && resumed->has("fields_count")) FieldOutput::onCheckpoint(*resumed);
  }

  void onStep(const CommittedStep& step) override {
    if (resumed_) takeBackFrom(step.step);
    resumed_ = false;
    for (Side side : flows()) {
      if (!step.flow[side]) return;
    }
    makeFolder();
    const Entry entry(step.step, step.t);
    const std::string wing = folder_ + "/" + entry.wing;
    for (Side side : flows()) {
      const std::string flow = folder_ + "/" + entry.flow[side];
      writeWhole(flow,
                 written<vtkXMLStructuredGridWriter>(flowGrid(case_, scales_, step, side), flow));
    }
    writeWhole(wing, written<vtkXMLPolyDataWriter>(wingSurface(case_, scales_, step), wing));
    entries_.push_back(entry);
    writeSeries();
  }

  /// The files of the run so far go.
  void onReset() override {
    for (const Entry& entry : entries_) {
      for (Side side : flows()) fs::remove(folder_ + "/" + entry.flow[side]);
      fs::remove(folder_ + "/" + entry.wing);
    }
    if (!entries_.empty()) fs::remove(folder_ + "/fields.pvd");
    entries_.clear();
  }

  /// The list of files; also the way back, for a run that goes on.
  void onCheckpoint(StateVisitor& state) override {
    std::size_t count = entries_.size();
    state("fields_count", count);
    Eigen::MatrixXd rows(2, count);
    for (std::size_t i = 0; !state.loading() && i < count; ++i) {
      rows(0, static_cast<Eigen::Index>(i)) = entries_[i].step;
      rows(1, static_cast<Eigen::Index>(i)) = entries_[i].t;
    }
    state("fields_steps_and_times", rows);
    for (std::size_t i = 0; state.loading() && i < count; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      entries_.emplace_back(static_cast<std::uint32_t>(rows(0, column)), rows(1, column));
    }
  }

  void onEnd(const std::string&) override {}

 private:
  struct Entry {
    Entry(std::uint32_t step_in, double t_in) : step(step_in), t(t_in) {
      char number[16];
      std::snprintf(number, sizeof number, "%08u", step);
      flow = {std::string("flow_") + number + ".vts", std::string("flow_left_") + number + ".vts"};
      wing = std::string("wing_") + number + ".vtp";
    }
    std::uint32_t step;
    double t;
    PerWing<std::string> flow;
    std::string wing;
  };

  /// A run that goes on flies `step` and what is behind it anew, perhaps without files of the same
  /// steps as before.
  void takeBackFrom(std::uint32_t step) const {
    if (!fs::exists(folder_)) return;
    for (const fs::directory_entry& file : fs::directory_iterator(folder_)) {
      const std::string name = file.path().filename();
      unsigned number = 0;
      const bool ours = std::sscanf(name.c_str(), "flow_%8u.vts", &number) == 1 ||
                        std::sscanf(name.c_str(), "flow_left_%8u.vts", &number) == 1 ||
                        std::sscanf(name.c_str(), "wing_%8u.vtp", &number) == 1;
      if (ours && number >= step) fs::remove(file.path());
    }
    if (entries_.empty()) {
      fs::remove(folder_ + "/fields.pvd");
    } else {
      writeSeries();
    }
  }

  /// Files of a step: one flow that stands for both wings, or two.
  Sides flows() const { return case_.sides(); }

  void makeFolder() const {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw OutputError(folder_ + ": cannot be created (" + error.message() + ")");
  }

  /// fields.pvd: ParaView's own list of files with their times; part 0 the flow, part 1 the wings,
  /// part 2 the left wing's flow where it is solved.
  void writeSeries() const {
    vtkNew<vtkXMLDataElement> file, collection;
    file->SetName("VTKFile");
    file->SetAttribute("type", "Collection");
    file->SetAttribute("version", "0.1");
    collection->SetName("Collection");
    for (const Entry& entry : entries_) {
      const std::tuple<const char*, std::string> parts[] = {
          {"flow", entry.flow.right}, {"wings", entry.wing}, {"flow left", entry.flow.left}};
      for (int part = 0; part < (case_.mirrored ? 2 : 3); ++part) {
        const auto& [name, path] = parts[part];
        vtkNew<vtkXMLDataElement> item;
        item->SetName("DataSet");
        char time[32];
        std::snprintf(time, sizeof time, "%.17g", entry.t);
        item->SetAttribute("timestep", time);
        item->SetIntAttribute("part", part);
        item->SetAttribute("name", name);
        item->SetAttribute("file", path.c_str());
        collection->AddNestedElement(item);
      }
    }
    file->AddNestedElement(collection);
    std::ostringstream text;
    text << "<?xml version=\"1.0\"?>\n";
    file->PrintXML(text, vtkIndent());
    writeWhole(folder_ + "/fields.pvd", text.str());
  }

  const Case case_;
  const std::string folder_;
  const FieldScales scales_;
  std::vector<Entry> entries_;
  bool resumed_;  // and no step of it has come yet
};

}  // namespace

std::unique_ptr<StepSink> makeFieldOutput(const Case& c, const std::string& folder,
                                          StateVisitor* resumed) {
  return std::make_unique<FieldOutput>(c, folder, resumed);
}

}  // namespace monarch_flight
