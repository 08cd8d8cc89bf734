#include "objects.h"

#include <algorithm>

namespace vlf::app {

namespace {

constexpr float kSpeed = 0.15f;  // of the room's radius, a second
constexpr float kTurn = 1.5f;    // radians a second
constexpr float kFast = 3;
constexpr float kBeside = 0.15f;        // of an object's size, between it and its copy
constexpr float kFarthestPlace = 0.6f;  // of the way to what is seen

}  // namespace

Objects::Objects(Scenario scenario, ModelLibrary library, Say say)
    : scenario_(std::move(scenario)), library_(std::move(library)), say_(std::move(say)) {
    for (std::size_t i = 0; i < size(); ++i) ids_.push_back(++lastId_);
}

void Objects::enter(std::shared_ptr<const BakedRoom> room, const RayScene& rays,
                    std::shared_ptr<const IrradianceAtlas> light) {
    std::vector<DynamicObject> present;
    for (std::size_t i = 0; dynamic_ && i < size(); ++i) present.push_back(now(i));
    dynamic_.reset();
    room_ = std::move(room);
    rays_ = &rays;
    light_ = std::move(light);
    if (size() == 0) return;
    build();
    for (DynamicObject& object : present.empty() ? objectsAt(scenario_, 0) : present)
        dynamic_->add(std::move(object));
}

void Objects::build() {
    dynamic_ = std::make_unique<DynamicRoom>(room_->scene, *rays_, room_->field);
    if (light_) dynamic_->setRoomIrradiance(*light_);
}

void Objects::setLight(std::shared_ptr<const IrradianceAtlas> light) {
    light_ = std::move(light);
    if (dynamic_) dynamic_->setRoomIrradiance(*light_);
}

bool Objects::update(double seconds, const Vec3& eye) {
    if (playing_)
        playedSeconds_ = seconds - pausedSeconds_;
    else
        pausedSeconds_ = seconds - playedSeconds_;
    if (!dynamic_) return false;
    moveTo(*dynamic_, scenario_, std::max(playedSeconds_, 0.0));
    dynamic_->setViewers({&eye, 1});
    return dynamic_->update();
}

void Objects::toggleSubject() {
    if (subject_ == Subject::object) {
        subject_ = Subject::camera;
        return say_("keys move the camera");
    }
    if (size() == 0) return say_("there is no object: add one in the panel");
    if (!selected_) selected_ = 0;
    subject_ = Subject::object;
    say_("keys move " + now(*selected_).name);
}

void Objects::select(std::optional<std::size_t> i) {
    if (selected_ == i) return;
    selected_ = i;
    if (!i) subject_ = Subject::camera;
    say_(i ? "selected " + scenario_.objects[*i].object.name : "no object selected");
}

void Objects::selectNext() {
    if (size() == 0) return say_("there is no object: add one in the panel");
    const std::size_t next = selected_ ? (*selected_ + 1) % size() : 0;
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
    return dynamic_->litNumbers()[hit.instance];
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
    selected_ = size() - 1;
}

void Objects::add(ScenarioObject object) {
    std::vector<std::string> warnings;
    object.object.model = library_.model(object.source, warnings);
    object.object.name = unusedName(scenario_, object.object.name);
    insert(std::move(object));
    say_("added " + scenario_.objects.back().object.name);
    if (!warnings.empty()) say_(warnings.front());
}

void Objects::duplicate(std::size_t i) {
    ScenarioObject copy = scenario_.objects[i];
    copy.object.pose = now(i).pose;
    copy.motion = {};
    const float radius = copy.object.pose.scale * copy.object.model->bounds().radius;
    copy.object.pose.translation += copy.object.pose.direction({2 * (1 + kBeside) * radius, 0, 0});
    copy.object.name = unusedName(scenario_, copy.object.name);
    insert(std::move(copy));
    say_("added " + scenario_.objects.back().object.name);
}

void Objects::remove(std::size_t i) {
    const std::string name = scenario_.objects[i].object.name;
    dynamic_->remove(i);
    scenario_.objects.erase(scenario_.objects.begin() + static_cast<std::ptrdiff_t>(i));
    ids_.erase(ids_.begin() + static_cast<std::ptrdiff_t>(i));
    selected_.reset();
    subject_ = Subject::camera;
    say_("removed " + name);
}

void Objects::setPose(std::size_t i, const Pose& pose) {
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
    scenario_.objects[i].object.visible = visible;
    dynamic_->setVisible(i, visible);
}

void Objects::setSettings(std::size_t i, const ObjectSettings& settings) {
    dynamic_->setSettings(i, settings);
    scenario_.objects[i].object.settings = settings;
}

void Objects::setSource(std::size_t i, const ObjectSource& source) {
    std::vector<std::string> warnings;
    ScenarioObject& object = scenario_.objects[i];
    object.object.model = library_.model(source, warnings);
    object.source = source;
    dynamic_->setModel(i, object.object.model);
}

}  // namespace vlf::app
