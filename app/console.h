#pragma once
// What the command line prints while it works.

#include "vlf/base/progress.h"

#include <chrono>
#include <string>

namespace vlf::app {

/// Progress on standard error: a bar with the time left on a terminal, a plain line per stage and
/// tenth otherwise, nothing when quiet. Ctrl-C (SIGINT) and SIGTERM cancel the newest one alive; a
/// second one ends the program at once.
class ConsoleProgress : public Progress {
  public:
    explicit ConsoleProgress(bool quiet);
    ~ConsoleProgress() override;

    void stage(const std::string& name) override;
    void update(double fraction) override;

  protected:
    /// Prints a line, apart from the bar; nothing when quiet.
    void say(const std::string& text);

  private:
    void draw(double fraction);
    void endStage();

    bool quiet_, terminal_;
    std::string stage_;
    int lastTenth_ = -1;
    std::chrono::steady_clock::time_point stageStart_, lastDraw_;
};

/// "warning: ..." on standard error, unless quiet.
void printWarning(bool quiet, const std::string& text);

}  // namespace vlf::app
