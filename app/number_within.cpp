#include "number_within.h"

#include <fmt/format.h>

namespace vlf::app {

CLI::Validator numberWithin(double least, double most) {
    const auto problem = [least, most](const std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most)
            return std::string();
        return fmt::format("must be a number between {} and {}", least, most);
    };
    return {problem, "", "number"};
}

}  // namespace vlf::app
