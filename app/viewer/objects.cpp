#include "objects.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <utility>

namespace vlf::app {

namespace {

constexpr float kSpeed = 0.15f;  // of the room's radius, a second
constexpr float kTurn = 1.5f;    // radians a second
constexpr float kFast = 3;
constexpr float kBeside = 0.15f;        // of an object's size, between it and its copy
constexpr float kFarthestPlace = 0.6f;  // of the way to what is seen
constexpr float kFarthest = 1e5f;       // metres from the origin, whatever moves an object

void showAtEveryKeyframe(Motion& motion, bool visible) {
    if (auto* keyframes = std::get_if<KeyframeMotion>(&motion))
        for (Keyframe& keyframe : keyframes->keyframes) keyframe.visible = visible;
}

void limitReflectance(ObjectSource& source, const ObjectSource& before) {
    if (!source.diffuse || !source.mirror) return;
    const bool mirrorStays = source.mirror != before.mirror;
    const Vec3& stays = mirrorStays ? *source.mirror : *source.diffuse;
    Vec3& givesWay = mirrorStays ? *source.diffuse : *source.mirror;
    givesWay = glm::min(givesWay, glm::max(Vec3(1) - stays, Vec3(0)));
}

}  // namespace

Objects::Objects(Scenario scenario, ModelLibrary library, Say say)
    : scenario_(std::move(scenario)), library_(std::move(library)), say_(std::move(say)) {
    for (std::size_t i = 0; i < size(); ++i) ids_.push_back(++lastId_);
}

void Objects::enter(std::shared_ptr<const BakedRoom> room, const RayScene& rays,
                    std::shared_ptr<const IrradianceAtlas> light) {
    std::vector<DynamicObject> present;
    for (std::size_t i = 0; dynamic_ && i < size(); ++i) present.push_back(now(i));
    if (present.empty()) {
        present = objectsAt(scenario_, 0);
        // One that cannot be lit is found now, not when its motion has it appear.
        for (std::size_t i = 0; i < size(); ++i)
            present[i].visible = present[i].visible || moves(scenario_.objects[i].motion);
    }
    dynamic_.reset();
    room_ = std::move(room);
    rays_ = &rays;
    light_ = std::move(light);
    if (size() == 0) return;
    build();
    for (DynamicObject& object : present) dynamic_->add(std::move(object));
    findLight();
}

void Objects::build() {
    dynamic_ = std::make_unique<DynamicRoom>(room_->scene, *rays_, room_->field);
    if (light_) dynamic_->setRoomIrradiance(*light_);
}

void Objects::setLight(std::shared_ptr<const IrradianceAtlas> light) {
    light_ = std::move(light);
    if (dynamic_) dynamic_->setRoomIrradiance(*light_);
}

bool Objects::update(double seconds, const Vec3& eye, const Show& show) {
    if (playing_)
        playedSeconds_ = seconds - pausedSeconds_;
    else
        pausedSeconds_ = seconds - playedSeconds_;
    if (!dynamic_) return false;
    moveTo(*dynamic_, scenario_, std::max(playedSeconds_, 0.0));
    dynamic_->setViewers({&eye, 1});
    try {
        return light(show);
    } catch (const InputError& e) {
        if (before_.empty()) throw;
        takeBack();
        say_(e.what());
        moveTo(*dynamic_, scenario_, std::max(playedSeconds_, 0.0));
        return light(show);
    }
}

bool Objects::light(const Show& show) {
    findLight();
    if (unshown_) show(*dynamic_);
    before_.clear();
    return std::exchange(unshown_, false);
}

void Objects::findLight() {
    if (!dynamic_->update()) return;
    unshown_ = true;
    litIds_.clear();
    for (const std::size_t i : dynamic_->litNumbers()) litIds_.push_back(ids_[i]);
}

/// To be called before an object is changed.
void Objects::keep(std::size_t i) {
    before_.try_emplace(ids_[i], scenario_.objects[i]);
}

void Objects::takeBack() {
    for (auto& [id, before] : std::exchange(before_, {})) {
        const std::optional<std::size_t> i = indexOf(id);
        if (!i) continue;
        if (!before) {
            erase(*i);
            continue;
        }
        dynamic_->setPose(*i, before->object.pose);
        dynamic_->setVisible(*i, before->object.visible);
        dynamic_->setSettings(*i, before->object.settings);
        dynamic_->setModel(*i, before->object.model);
        scenario_.objects[*i] = std::move(*before);
    }
}

std::optional<std::size_t> Objects::indexOf(std::uint64_t id) const {
    const auto found = std::find(ids_.begin(), ids_.end(), id);
    if (found == ids_.end()) return {};
    return static_cast<std::size_t>(found - ids_.begin());
}

std::vector<DynamicObject> Objects::visible() const {
    std::vector<DynamicObject> all;
    for (std::size_t i = 0; i < size(); ++i)
        if (now(i).visible) all.push_back(now(i));
    return all;
}

bool Objects::shown(std::size_t i) const {
    const auto changed = before_.find(ids_[i]);
    return changed == before_.end() || changed->second.has_value();
}

/// Behind the selected one, which is the last to be looked at.
std::optional<std::size_t> Objects::nextVisible() const {
    const std::size_t first = selected_ ? *selected_ + 1 : 0;
    for (std::size_t k = 0; k < size(); ++k)
        if (const std::size_t i = (first + k) % size(); now(i).visible) return i;
    return {};
}

void Objects::sayNoneIsVisible() const {
    say_(size() == 0 ? "there is no object: add one in the panel"
                     : "all objects are hidden: show one in the panel");
}

void Objects::toggleSubject() {
    if (subject_ == Subject::object) {
        subject_ = Subject::camera;
        return say_("keys move the camera");
    }
    if (!selected_) selected_ = nextVisible();
    if (!selected_) return sayNoneIsVisible();
    if (!now(*selected_).visible)
        return say_(name(*selected_) + " is hidden: show it in the panel");
    subject_ = Subject::object;
    say_("keys move " + name(*selected_));
}

void Objects::select(std::optional<std::size_t> i) {
    if (selected_ == i) return;
    selected_ = i;
    if (!i) subject_ = Subject::camera;
    say_(i ? "selected " + name(*i) : "no object selected");
}

void Objects::selectNext() {
    const std::optional<std::size_t> next = nextVisible();
    if (!next) return sayNoneIsVisible();
    selected_.reset();
    select(next);
}

void Objects::setPlaying(bool on) {
    playing_ = on;
    say_(on ? "motions go on" : "motions stand still");
}

void Objects::steer(const ObjectSteering& steering, float seconds) {
    if (!selected_ || !steering.any()) return;
    const float hurry = seconds * (steering.fast ? kFast : 1.0f);
    Pose pose = now(*selected_).pose;
    const float metres = kSpeed * boundingSphere(room_->scene).radius * hurry;
    pose.translation += metres * pose.direction(steering.push);
    const Vec2 angle = kTurn * hurry * steering.spin;
    pose.rotation = glm::normalize(pose.rotation * glm::angleAxis(angle.x, Vec3(0, 1, 0)) *
                                   glm::angleAxis(angle.y, Vec3(1, 0, 0)));
    setPose(*selected_, pose);
}

std::optional<std::size_t> Objects::pick(const Ray& ray) const {
    if (!dynamic_ || dynamic_->rays().empty()) return {};
    const InstanceHit hit = dynamic_->rays().closest(ray);
    if (!hit || rays_->closest(ray).t < hit.hit.t) return {};
    return indexOf(litIds_[hit.instance]);
}

Vec3 Objects::placeAlong(const Ray& ray, float radius) const {
    const float reach = rays_->closest(ray).t;
    const float away = std::min(3 * radius, kFarthestPlace * reach);
    return ray.origin + (away + radius) * glm::normalize(ray.direction);
}

void Objects::insert(ScenarioObject object) {
    if (!dynamic_) build();
    DynamicObject present = object.object;
    present.pose = poseAt(object.motion, object.object.pose, playedSeconds_);
    dynamic_->add(std::move(present));
    scenario_.objects.push_back(std::move(object));
    ids_.push_back(++lastId_);
    before_[lastId_] = std::nullopt;
    selected_ = size() - 1;
    say_("added " + name(*selected_));
}

void Objects::add(ScenarioObject object) {
    std::vector<std::string> warnings;
    object.object.model = library_.model(object.source, warnings);
    object.object.name = unusedName(scenario_, object.object.name);
    insert(std::move(object));
    if (!warnings.empty()) say_(warnings.front());
}

void Objects::duplicate(std::size_t i) {
    ScenarioObject copy{scenario_.objects[i].source, now(i), {}};
    const float radius = copy.object.pose.scale * copy.object.model->bounds().radius;
    copy.object.pose.translation += copy.object.pose.direction({2 * (1 + kBeside) * radius, 0, 0});
    copy.object.name = unusedName(scenario_, name(i));
    insert(std::move(copy));
}

void Objects::erase(std::size_t i) {
    dynamic_->remove(i);
    scenario_.objects.erase(scenario_.objects.begin() + static_cast<std::ptrdiff_t>(i));
    ids_.erase(ids_.begin() + static_cast<std::ptrdiff_t>(i));
    if (selected_ == i) {
        selected_.reset();
        subject_ = Subject::camera;
    } else if (selected_ && *selected_ > i) {
        --*selected_;
    }
}

void Objects::remove(std::size_t i) {
    const std::string removed = name(i);
    erase(i);
    say_("removed " + removed);
}

void Objects::setPose(std::size_t i, Pose pose) {
    pose.translation = glm::clamp(pose.translation, -kFarthest, kFarthest);
    ScenarioObject& object = scenario_.objects[i];
    dynamic_->setPose(i, pose);
    if (moves(object.motion)) {
        object.object.visible = now(i).visible;
        object.motion = {};
        say_(object.object.name + " no longer moves by itself");
    }
    object.object.pose = pose;
}

void Objects::setVisible(std::size_t i, bool visible) {
    keep(i);
    ScenarioObject& object = scenario_.objects[i];
    object.object.visible = visible;
    showAtEveryKeyframe(object.motion, visible);
    dynamic_->setVisible(i, visible);
    if (!visible && selected_ == i && subject_ == Subject::object) toggleSubject();
}

void Objects::setSettings(std::size_t i, const ObjectSettings& settings) {
    keep(i);
    dynamic_->setSettings(i, settings);
    scenario_.objects[i].object.settings = settings;
}

void Objects::setName(std::size_t i, const std::string& name) {
    if (name.empty()) return;
    std::string& own = scenario_.objects[i].object.name;
    own.clear();
    own = unusedName(scenario_, name);
}

void Objects::setSource(std::size_t i, ObjectSource source) {
    std::vector<std::string> warnings;
    ScenarioObject& object = scenario_.objects[i];
    limitReflectance(source, object.source);
    auto model = library_.model(source, warnings);
    keep(i);
    dynamic_->setModel(i, model);
    object.object.model = std::move(model);
    object.source = std::move(source);
}

}  // namespace vlf::app
