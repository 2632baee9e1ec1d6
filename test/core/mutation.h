#pragma once
#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace monarch_flight {

/// Breaks texts in the ways in which files get broken: by a slip of the hand, by a wrong value, by
/// a bad disk. The same seed breaks the same.
class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text) {
    const int times = 1 + pick(3);
    for (int i = 0; i < times && !text.empty(); ++i) text = once(std::move(text));
    return text;
  }
  int pick(std::size_t n) { return static_cast<int>(random_() % n); }

 private:
  std::string once(std::string text) {
    switch (pick(9)) {
      case 0:
        return text.substr(0, at(text));
      case 1:
        text[at(text)] = static_cast<char>(pick(256));
        return text;
      case 2:
        text.insert(at(text), 1, "{}[]:,&*!|>%@`\"'#-?\n\t \0"[pick(24)]);
        return text;
      case 3:
        return text.erase(at(text), 1 + at(text) % 20);
      case 4:
        return lines(text, false);
      case 5:
        return lines(text, true);
      case 6:
        return alias(std::move(text));
      default:
        return value(std::move(text));
    }
  }
  std::size_t at(const std::string& text) { return random_() % text.size(); }
  // Deletes a line, or puts a copy of it somewhere else.
  std::string lines(const std::string& text, bool copy) {
    std::vector<std::string> all{""};
    for (char c : text) {
      all.back() += c;
      if (c == '\n') all.emplace_back();
    }
    const std::size_t which = random_() % all.size(), where = random_() % all.size();
    const std::string line = all[which];
    const auto spot = all.begin() + static_cast<std::ptrdiff_t>(copy ? where : which);
    if (copy) {
      all.insert(spot, line);
    } else {
      all.erase(spot);
    }
    std::string out;
    for (const std::string& l : all) out += l;
    return out;
  }
  // A value gets a name, and a later one refers to it: often a section to itself.
  static std::string alias(std::string text, std::size_t begin) {
    const std::size_t anchor = text.find(": ", begin);
    if (anchor == std::string::npos) return text;
    text.insert(anchor + 2, "&a ");
    const std::size_t from = text.find(": ", anchor + 5);
    if (from == std::string::npos) return text;
    const std::size_t end = std::min(text.find_first_of(",}\n", from), text.size());
    return text.replace(from + 2, end - from - 2, "*a");
  }
  std::string alias(std::string text) {
    const std::size_t begin = at(text);
    return alias(std::move(text), begin);
  }
  // Another value for a number.
  std::string value(std::string text) {
    static const char* const kValues[] = {"nan",
                                          "inf",
                                          "-inf",
                                          "1e308",
                                          "-1",
                                          "0",
                                          "1e-320",
                                          "4294967296",
                                          "-0.0",
                                          "true",
                                          "none",
                                          "[]",
                                          "{}",
                                          "[1, 2]",
                                          "~",
                                          "0x7f",
                                          "1e400",
                                          "\"\"",
                                          "rubbish",
                                          "1e9",
                                          "3.5",
                                          "99999999999999999999",
                                          "../../../../etc/passwd",
                                          "/dev/zero"};
    std::size_t begin = at(text);
    while (begin < text.size() && !isDigit(text[begin])) ++begin;
    std::size_t end = begin;
    while (end < text.size() && (isDigit(text[end]) || text[end] == '.' || text[end] == 'e')) ++end;
    if (begin < text.size()) text.replace(begin, end - begin, kValues[pick(std::size(kValues))]);
    return text;
  }
  static bool isDigit(char c) { return c >= '0' && c <= '9'; }

  std::mt19937 random_;
};

}  // namespace monarch_flight
