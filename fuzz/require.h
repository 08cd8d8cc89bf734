#pragma once
// What a reading function promises and did not keep.

#include "vlf/base/error.h"

#include <stdexcept>
#include <string>

namespace vlf::fuzz {

inline void require(bool kept, const char* promise) {
    if (!kept) throw std::logic_error(std::string("accepted, but not ") + promise);
}

/// Calls read(); false if that throws an Error.
template <class Read>
bool isAccepted(const Read& read) {
    try {
        read();
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// Calls check() of something that was accepted; what it finds wrong is no Error of the file.
template <class Check>
void requireAccepted(const Check& check) {
    try {
        check();
    } catch (const Error& e) {
        throw std::logic_error(std::string("accepted, but unsound: ") + e.what());
    }
}

}  // namespace vlf::fuzz
