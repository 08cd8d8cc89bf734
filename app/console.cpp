#include "console.h"

#include <atomic>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace vlf::app {

namespace {

std::atomic<Progress*> active{nullptr};

extern "C" void onInterrupt(int signal) {
    if (Progress* progress = active.load()) progress->cancel();
    std::signal(signal, SIG_DFL);
}

double seconds(std::chrono::steady_clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

}  // namespace

ConsoleProgress::ConsoleProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {
    active.store(this);
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
}

ConsoleProgress::~ConsoleProgress() {
    endStage();
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    active.store(nullptr);
}

void ConsoleProgress::stage(const std::string& name) {
    endStage();
    stage_ = name;
    lastTenth_ = -1;
    stageStart_ = std::chrono::steady_clock::now();
    lastDraw_ = {};
    if (!quiet_ && !terminal_) fmt::print(stderr, "{} ...\n", name);
}

void ConsoleProgress::update(double fraction) {
    if (quiet_ || stage_.empty()) return;
    const auto now = std::chrono::steady_clock::now();
    if (terminal_) {
        if (seconds(now - lastDraw_) < 0.1 && fraction < 1) return;
        lastDraw_ = now;
        draw(fraction);
    } else if (const int tenth = static_cast<int>(10 * fraction);
               tenth > lastTenth_ && tenth > 0 && seconds(now - stageStart_) > 2) {
        lastTenth_ = tenth;
        fmt::print(stderr, "{} {} %\n", stage_, 10 * tenth);
    }
}

void ConsoleProgress::say(const std::string& text) {
    if (quiet_) return;
    fmt::print(stderr, "{}{}\n", terminal_ && !stage_.empty() ? "\n" : "", text);
}

void ConsoleProgress::draw(double fraction) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(kWidth * fraction);
    const double elapsed = seconds(std::chrono::steady_clock::now() - stageStart_);
    const std::string left = fraction > 0.01 && fraction < 1
                                 ? fmt::format("{:.0f} s left", elapsed / fraction - elapsed)
                                 : fmt::format("{:.1f} s", elapsed);
    fmt::print(stderr, "\r{:<22} [{:=<{}}{:<{}}] {:3.0f} %  {:<14}", stage_, "", filled, "",
               kWidth - filled, 100 * fraction, left);
}

void ConsoleProgress::endStage() {
    if (stage_.empty() || quiet_) return;
    const double elapsed = seconds(std::chrono::steady_clock::now() - stageStart_);
    if (terminal_) {
        draw(cancelled() ? 0 : 1);
        fmt::print(stderr, "\n");
    } else if (elapsed > 2) {
        fmt::print(stderr, "{} took {:.1f} s\n", stage_, elapsed);
    }
    stage_.clear();
}

void printWarning(bool quiet, const std::string& text) {
    if (!quiet) fmt::print(stderr, "warning: {}\n", text);
}

}  // namespace vlf::app
