#include "frame_names.h"

#include <regex>

#include <fmt/format.h>

namespace vlf::app {

namespace {

/// What is before the number, its digits, what is after it.
const std::regex kPattern("([^%]*)%(?:0([1-9]))?d([^%]*)");

}  // namespace

std::string framePatternProblem(const std::string& pattern) {
    if (std::regex_match(pattern, kPattern)) return {};
    return pattern + " must hold the frame's number once, as %05d, and no other %";
}

std::string frameName(const std::string& pattern, int frame) {
    std::smatch parts;
    std::regex_match(pattern, parts, kPattern);
    const int digits = parts[2].matched ? std::stoi(parts[2]) : 1;
    return fmt::format("{}{:0{}}{}", parts[1].str(), frame, digits, parts[3].str());
}

}  // namespace vlf::app
