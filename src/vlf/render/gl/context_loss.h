#pragma once
// Whether the driver has been reset beneath a program.

namespace vlf::gl {

/// True once the current context is lost: nothing it holds can be used again. Told only to contexts
/// that were made with a reset notification strategy.
bool contextLost();

}  // namespace vlf::gl
