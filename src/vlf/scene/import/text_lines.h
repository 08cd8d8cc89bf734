#pragma once
// Lines, words and numbers of Wavefront text files (OBJ, MTL).

#include <optional>
#include <string>
#include <string_view>

namespace vlf {

/// Walks over the logical lines of a text: CR, LF or CRLF ends a line, a backslash before it joins
/// the line to the next. A UTF-8 byte order mark is skipped. The text must outlive the reader.
class LineReader {
  public:
    explicit LineReader(std::string_view text);

    /// Moves to the next line; false at the end of the text.
    bool next();

    /// The current line; valid until next() is called again.
    std::string_view line() const { return line_; }

    /// 1-based number of the physical line on which the current line begins.
    int number() const { return number_; }

  private:
    std::string_view takePhysicalLine();

    std::string_view rest_;
    std::string_view line_;
    std::string joined_;
    int number_ = 0, nextNumber_ = 1;
};

/// Words of a line, separated by blanks and tabs.
class WordReader {
  public:
    explicit WordReader(std::string_view line) : rest_(line) {}

    /// The next word; empty at the end of the line.
    std::string_view next();

    /// All that is left, without blanks around it.
    std::string_view rest() const;

  private:
    std::string_view rest_;
};

/// A number at the beginning of a word.
struct ParsedNumber {
    double value = 0;      ///< may be infinite or NaN
    bool complete = true;  ///< the number is the whole word
};

/// Reads a decimal number; nothing if the word does not begin with one.
std::optional<ParsedNumber> parseNumber(std::string_view word);

/// Reads a word that is an integer and nothing else.
std::optional<long long> parseInteger(std::string_view word);

}  // namespace vlf
