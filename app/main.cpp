#include "commands.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"

#include <csignal>
#include <cstdio>
#include <memory>
#include <new>

#include <fmt/format.h>

namespace {

constexpr int kFailed = 1, kUsage = 2, kBadInput = 3, kInterrupted = 130;

void addGlobals(CLI::App& app, vlf::app::Globals& globals) {
    app.add_option("--threads", globals.threads, "Threads to use (0: one per core)")
        ->check(CLI::Range(0, 1024));
    app.add_option("--seed", globals.seed, "Seed of all random numbers");
    app.add_flag("-q,--quiet", globals.quiet, "Print errors only");
    app.add_flag("-v,--verbose", globals.verbose, "Print more");
}

void addCommands(CLI::App& app, const vlf::app::Globals& globals) {
    using namespace vlf::app;
    addBake(app, globals);
    addInfo(app, globals);
    addRender(app, globals);
    addView(app, globals);
    addReference(app, globals);
    addCompare(app, globals);
    addCompareDynamic(app, globals);
    addScene(app, globals);
    addSheet(app, globals);
}

int run(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return kUsage;
    } catch (const vlf::Cancelled&) {
        fmt::print(stderr, "interrupted\n");
        return kInterrupted;
    } catch (const vlf::InputError& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return kBadInput;
    } catch (const vlf::Error& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return kFailed;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "error: out of memory\n");
        return kFailed;
    } catch (const std::exception& e) {
        fmt::print(stderr, "internal error: {}\n", e.what());
        return kFailed;
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Virtual light fields: bake a room's light once, walk through it in real time.",
                 "vlf");
    std::signal(SIGXFSZ, SIG_IGN);  // a file beyond its limit is an error of writing it
    app.set_version_flag("--version", "vlf " VLF_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    vlf::app::Globals globals;
    addGlobals(app, globals);
    // Subcommand callbacks run within parse(); the thread limit is in force before the first.
    std::unique_ptr<vlf::ThreadLimit> limit;
    app.parse_complete_callback(
        [&] { limit = std::make_unique<vlf::ThreadLimit>(globals.threads); });
    addCommands(app, globals);
    return run(app, argc, argv);
}
