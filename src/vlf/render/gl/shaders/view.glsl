layout(std140, binding = kViewBlock) uniform ViewBlock { ViewData view; };
layout(std140, binding = kMaterialBlock) uniform MaterialBlock { MaterialData material; };
