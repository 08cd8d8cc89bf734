#include "vlf/scene/import/text_lines.h"

#include <charconv>
#include <cstdlib>
#include <limits>

namespace vlf {

namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view trimmed(std::string_view s) {
    const std::size_t first = s.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return s.substr(first, s.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

LineReader::LineReader(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
}

std::string_view LineReader::takePhysicalLine() {
    const std::size_t end = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, end);
    std::size_t used = line.size();
    if (used < rest_.size()) used += rest_.substr(used).starts_with("\r\n") ? 2 : 1;
    rest_.remove_prefix(used);
    ++nextNumber_;
    return line;
}

bool LineReader::next() {
    if (rest_.empty()) return false;
    number_ = nextNumber_;
    line_ = takePhysicalLine();
    if (!line_.ends_with('\\')) return true;
    joined_.clear();
    while (line_.ends_with('\\')) {
        joined_.append(line_.substr(0, line_.size() - 1)).push_back(' ');
        line_ = rest_.empty() ? std::string_view{} : takePhysicalLine();
    }
    joined_.append(line_);
    line_ = joined_;
    return true;
}

std::string_view WordReader::next() {
    const std::size_t first = rest_.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) {
        rest_ = {};
        return {};
    }
    rest_.remove_prefix(first);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(word.size());
    return word;
}

std::string_view WordReader::rest() const {
    return trimmed(rest_);
}

std::optional<ParsedNumber> parseNumber(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    ParsedNumber number;
    const char* end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, number.value);
    if (result.ec == std::errc::invalid_argument) return std::nullopt;
    if (result.ec == std::errc::result_out_of_range)
        number.value = std::strtod(std::string(word).c_str(), nullptr);
    // Microsoft's runtime prints not-a-number and infinity as 1.#IND, 1.#QNAN and 1.#INF.
    if (result.ptr != end && *result.ptr == '#')
        number.value = std::numeric_limits<double>::quiet_NaN();
    number.complete = result.ptr == end;
    return number;
}

std::optional<long long> parseInteger(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    long long value = 0;
    const char* end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
    return value;
}

}  // namespace vlf
