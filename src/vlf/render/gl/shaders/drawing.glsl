#include "drawing_data.h"

layout(std140, binding = kDrawingBlock) uniform DrawingBlock { DrawingData drawing; };
