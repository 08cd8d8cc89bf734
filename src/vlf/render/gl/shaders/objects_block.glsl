// What is known of all objects, and each of them.

layout(std140, binding = kObjectsBlock) uniform ObjectsBlock { ObjectsData objects; };
layout(binding = kObjectUnit) uniform usamplerBuffer objectRecords;
