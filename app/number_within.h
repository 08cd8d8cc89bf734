#pragma once
// Numbers on the command line.

#include <CLI/CLI.hpp>

namespace vlf::app {

/// A validator: a number in [least, most]. NaN, which CLI::Range lets pass, is none.
CLI::Validator numberWithin(double least, double most);

}  // namespace vlf::app
