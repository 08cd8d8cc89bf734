// Libraries of one header that parse what they are given, compiled here so that sanitizers and
// coverage see into them: these functions go before those of the shared libraries.

#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
#undef STB_IMAGE_IMPLEMENTATION

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
