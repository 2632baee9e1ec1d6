#include "run/case/document.h"

#include <yaml-cpp/eventhandler.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "monarch_flight/math/errors.h"

namespace monarch_flight::case_file {
namespace {

constexpr int kDeepest = 32;  // sections within each other; a case has six

std::string at(const YAML::Mark& mark) {
  return "line " + std::to_string(mark.line + 1) + ", column " + std::to_string(mark.column + 1);
}

/// Goes through a document without keeping it; refuses what a tree of finite depth is not.
class Walk : public YAML::EventHandler {
 public:
  explicit Walk(const std::string& name) : name_(name) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw InputError(name_ + ": " + at(mark) +
                     " is an alias (*name), which a case must not hold; write its value out");
  }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void enter(const YAML::Mark& mark) {
    if (++depth_ <= kDeepest) return;
    throw InputError(name_ + ": " + at(mark) + " is nested deeper than " +
                     std::to_string(kDeepest) + " levels; correct its brackets or indents");
  }

  const std::string& name_;
  int depth_ = 0;
};

}  // namespace

YAML::Node caseDocument(const std::string& text, const std::string& name) {
  YAML::Node node;
  try {
    std::istringstream in(text);
    Walk walk(name);
    YAML::Parser(in).HandleNextDocument(walk);
    node = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    throw InputError(name + ": " + at(e.mark) + " is not YAML: " + e.msg + "; correct it");
  }
  if (!node.IsMap()) {
    throw InputError(name + ": holds no keys; it must be a map as in docs/case_files.md");
  }
  return node;
}

YAML::Node caseFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be read; check the path and its permissions");
  return caseDocument({std::istreambuf_iterator<char>(in), {}}, path);
}

}  // namespace monarch_flight::case_file
