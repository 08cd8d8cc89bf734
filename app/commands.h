#pragma once
// One function per subcommand, one file each: it declares the options and runs the command as the
// subcommand's callback. Errors are thrown; main turns them into messages and exit codes.

#include <cstdint>

#include <CLI/CLI.hpp>

namespace vlf::app {

/// Options every subcommand has.
struct Globals {
    int threads = 0;  ///< 0: one per core
    std::uint64_t seed = 0;
    bool quiet = false;
    bool verbose = false;
};

void addBake(CLI::App& app, const Globals& globals);
void addInfo(CLI::App& app, const Globals& globals);
void addRender(CLI::App& app, const Globals& globals);
void addReference(CLI::App& app, const Globals& globals);
void addCompare(CLI::App& app, const Globals& globals);
void addCompareDynamic(CLI::App& app, const Globals& globals);
void addScene(CLI::App& app, const Globals& globals);
void addView(CLI::App& app, const Globals& globals);
void addSheet(CLI::App& app, const Globals& globals);

}  // namespace vlf::app
