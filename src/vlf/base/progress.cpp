#include "vlf/base/progress.h"

#include "vlf/base/error.h"

namespace vlf {

void Progress::check() const {
    if (cancelled()) throw Cancelled();
}

}  // namespace vlf
