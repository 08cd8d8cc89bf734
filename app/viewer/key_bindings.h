#pragma once
// Every key of the walkthrough, in one table: what it does and what the help says of it.

#include "objects.h"

#include "vlf/display/keys.h"
#include "vlf/math/vector.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vlf::app {

class Viewer;

struct Binding {
    std::string name{};  ///< of the keys, in the help; empty: the row before says it
    std::string help{};
    std::vector<Key> keys{};               ///< either of them; none: the row only informs
    std::function<void(Viewer&)> press{};  ///< once as a key goes down
    std::optional<bool> shift{};           ///< only with, or only without Shift
    std::optional<bool> control{};         ///< likewise Ctrl
    std::optional<Subject> subject{};      ///< only while the keys move this
    bool repeats = false;                  ///< `press` again and again while the key is held
    Vec3 go{0};                            ///< goes this way while a key is held: Steering::go
    Vec3 push{0};                          ///< ObjectSteering::push while a key is held
    Vec2 spin{0};                          ///< likewise ObjectSteering::spin
    bool fast = false;                     ///< in a hurry while a key is held
};

const std::vector<Binding>& keyBindings();

/// The rows of the table as text, a line each.
std::string keyHelp();

}  // namespace vlf::app
