#pragma once
// What draws in the current context, and whether it is well.

namespace vlf::gl {

/// True once the context is lost, for instance because the driver was reset: nothing it holds can
/// be used again. Told only to contexts that were made with a reset notification strategy.
bool contextLost();

/// Whether the CPU draws, for which several samples a pixel are several times the work.
bool drawsOnCpu();

}  // namespace vlf::gl
