#include "live_view.h"

#include "numbered_file.h"

#include "vlf/base/error.h"
#include "vlf/io/field_file.h"

#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace vlf::app {

LiveView::LiveView(LiveBake& bake, std::string stem, std::string output, Say say)
    : bake_(bake),
      stem_(std::move(stem)),
      output_(std::move(output)),
      say_(std::move(say)),
      unsaved_(!output_.empty()) {}

std::optional<LiveUpdate> LiveView::poll() {
    reportSaved();
    std::optional<LiveUpdate> update = bake_.poll();
    if (update && update->complete && unsaved_) save();
    return update;
}

std::string LiveView::activity() const {
    const LiveStatus status = bake_.status();
    if (status.complete || status.activity.empty()) return {};
    std::string line = status.preset.empty()
                           ? status.activity
                           : fmt::format("{}: {}", status.preset, status.activity);
    if (status.fraction > 0) line += fmt::format(" {:.0f} %", 100 * status.fraction);
    if (status.missingLight < 1)
        line += fmt::format(", light still missing {:.2g} %", 100 * status.missingLight);
    return line;
}

void LiveView::save() {
    if (saving_.valid()) return say_("still writing the last one");
    const std::shared_ptr<const BakedRoom> room = bake_.finished();
    if (!room) return say_("nothing to save yet: no preset is finished");
    unsaved_ = false;
    saving_ = std::async(std::launch::async, [room, stem = stem_, output = output_]() {
        try {
            const auto write = [&](const std::string& name) { writeField(name, *room); };
            std::string name = output;
            if (output.empty())
                name = writeNumberedFile(stem, "vlf", write);
            else
                write(name);
            return fmt::format("{} written, preset {}", name, room->field.record.preset);
        } catch (const Error& e) {
            return std::string(e.what());
        }
    });
}

void LiveView::finish() {
    if (unsaved_) save();
    if (saving_.valid()) say_(saving_.get());
}

void LiveView::reportSaved() {
    if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        say_(saving_.get());
}

}  // namespace vlf::app
