#pragma once
// Objects with all that is needed to write them down and to read them again: what they are made of,
// where they are, how they are lit and how they move.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/motion.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vlf {

/// What an object is made of: a primitive or a scene file, one of the two.
struct ObjectSource {
    std::string primitive;  ///< of primitiveNames()
    std::string file;       ///< see importScene
    /// In place of what all its materials have, textures included.
    std::optional<Vec3> diffuse, mirror, emission;

    friend auto operator<=>(const ObjectSource& a, const ObjectSource& b) {
        return a.key() <=> b.key();
    }
    friend bool operator==(const ObjectSource&, const ObjectSource&) = default;

  private:
    std::string key() const;
};

/// Models by their source; objects of the same source share one as long as there are any.
class ModelLibrary {
  public:
    /// Throws as importScene, makePrimitive and ObjectModel. What the importer remarks is added to
    /// `warnings`.
    std::shared_ptr<const ObjectModel> model(const ObjectSource& source,
                                             std::vector<std::string>& warnings);

  private:
    std::map<ObjectSource, std::weak_ptr<const ObjectModel>> models_;
};

struct ScenarioObject {
    ObjectSource source;
    DynamicObject object;  ///< its pose is where its motion begins; the model may be missing
    Motion motion;
};

struct Scenario {
    std::vector<ScenarioObject> objects;
};

/// The name, with a number behind it if an object has it already.
std::string unusedName(const Scenario& scenario, const std::string& name);

/// Gives every object that has none its model. Throws as ModelLibrary::model, naming the object.
void loadModels(Scenario& scenario, ModelLibrary& library, std::vector<std::string>& warnings);

/// The objects as they are at a time, s.
std::vector<DynamicObject> objectsAt(const Scenario& scenario, double seconds);

/// Moves the room's objects, which are those of the scenario in the same order, to where they are
/// at a time, s.
void moveTo(DynamicRoom& room, const Scenario& scenario, double seconds);

}  // namespace vlf
