#pragma once
// A room baked again, with its objects as part of it, beside the window.

#include "vlf/base/progress.h"
#include "vlf/dynamic/object.h"
#include "vlf/io/field_file.h"

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace vlf::app {

/// With the parameters that the room's field records. Destruction waits for the end: cancel() and
/// done() before.
class Rebake {
  public:
    Rebake(std::shared_ptr<const BakedRoom> room, std::vector<DynamicObject> objects);
    ~Rebake() { cancel(); }

    void cancel() { progress_.cancel(); }
    bool done() const;

    /// What is being done, in a line.
    std::string activity() const;

    /// Precondition: done(). Throws as bake().
    std::shared_ptr<const BakedRoom> result() { return result_.get(); }

  private:
    class Activity : public Progress {
      public:
        void stage(const std::string& name) override;
        void update(double fraction) override { fraction_ = fraction; }
        std::string text() const;

      private:
        mutable std::mutex mutex_;
        std::string name_;
        std::atomic<double> fraction_ = 0;
    };

    Activity progress_;
    std::future<std::shared_ptr<const BakedRoom>> result_;
};

}  // namespace vlf::app
