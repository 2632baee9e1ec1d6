#pragma once
#include <string>

#include "case_fixture.h"

namespace monarch_flight {

/// A resolved case with this section `guidance` instead of its own.
inline std::string withGuidance(const Case& c, const std::string& section) {
  std::string text = c.resolved_yaml;
  const std::size_t from = text.find("guidance:"), to = text.find("\noutput:");
  EXPECT_LT(from, to);
  text.erase(from, to + 1 - from);
  return text + section;
}

/// Why a case is refused in which `what` is replaced by `by`; "": it is not.
inline std::string refusal(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  try {
    caseFromText(text, "changed", {}, CONFIG_DIR);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace monarch_flight
