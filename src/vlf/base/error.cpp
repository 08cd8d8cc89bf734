#include "vlf/base/error.h"

namespace vlf {

std::string toString(const SourceLocation& where) {
    std::string text = where.file;
    if (where.line > 0) text.append(":").append(std::to_string(where.line));
    if (!where.element.empty()) text.append(text.empty() ? "" : ": ").append(where.element);
    return text;
}

}  // namespace vlf
