// Of every harness: one thread, so that an input takes the same way each time.

#include "vlf/base/parallel.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    static const vlf::ThreadLimit one(1);
    return 0;
}
