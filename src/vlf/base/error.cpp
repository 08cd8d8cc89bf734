#include "vlf/base/error.h"

namespace vlf {

std::string toString(const SourceLocation& where) {
    std::string text = where.file;
    if (where.line > 0) text += ":" + std::to_string(where.line);
    if (!where.element.empty()) text += (text.empty() ? "" : ": ") + where.element;
    return text;
}

}  // namespace vlf
