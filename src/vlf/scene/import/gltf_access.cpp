// Accessors, buffer views and images of a glTF document, with every bound checked.

#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace vlf {

namespace {

/// Most elements of an accessor that no buffer view backs (all zero, or sparse).
constexpr std::size_t kMaxUnbackedElements = std::size_t{1} << 14;

/// Elements in a buffer.
struct ElementRange {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;

    const std::uint8_t* element(std::size_t i) const { return data + i * stride; }
};

/// A view that lies within its buffer. Indices of sparse accessors come here unchecked.
const tinygltf::BufferView& checkedView(const GltfFile& file, int index,
                                        const SourceLocation& where) {
    if (index < 0 || static_cast<std::size_t>(index) >= file.model.bufferViews.size())
        throw InputError(where, fmt::format("bufferViews[{}] does not exist", index));
    const tinygltf::BufferView& view = file.model.bufferViews[index];
    const std::size_t size = file.buffers[view.buffer].size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
        throw InputError(
            where,
            fmt::format("bufferViews[{}] lies outside of its buffer of {} bytes", index, size));
    return view;
}

ElementRange locate(const GltfFile& file, int viewIndex, std::size_t offset, std::size_t count,
                    std::size_t elementSize, const SourceLocation& where) {
    const tinygltf::BufferView& view = checkedView(file, viewIndex, where);
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : elementSize;
    const bool fits =
        elementSize <= view.byteLength && offset <= view.byteLength - elementSize &&
        (count == 0 || count - 1 <= (view.byteLength - elementSize - offset) / stride);
    if (!fits)
        throw InputError(
            where, fmt::format("{} elements do not fit into bufferViews[{}] of {} bytes", count,
                               viewIndex, view.byteLength));
    return {file.buffers[view.buffer].data() + view.byteOffset + offset, stride};
}

template <class T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

template <class T>
double loadInteger(const std::uint8_t* bytes, bool normalized) {
    const double value = load<T>(bytes);
    return normalized ? std::max(-1.0, value / std::numeric_limits<T>::max()) : value;
}

double loadNumber(const std::uint8_t* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return loadInteger<std::int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return loadInteger<std::uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return loadInteger<std::int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return loadInteger<std::uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return loadInteger<std::uint32_t>(bytes, normalized);
        default:
            return load<float>(bytes);
    }
}

/// Size in bytes of a component type of glTF; 0: not one.
std::size_t componentSize(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

std::size_t checkedComponentSize(int type, const SourceLocation& where) {
    const std::size_t size = componentSize(type);
    if (size == 0) throw InputError(where, fmt::format("unknown component type {}", type));
    return size;
}

const tinygltf::Accessor& checkedAccessor(const GltfFile& file, int index, int components,
                                          const SourceLocation& where) {
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    const int found = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (found != components)
        throw InputError(where, fmt::format("accessors[{}] has {} components instead of {}", index,
                                            found, components));
    if (accessor.bufferView < 0 && accessor.count > kMaxUnbackedElements)
        throw InputError(
            where, fmt::format("accessors[{}] has {} elements and no data", index, accessor.count));
    return accessor;
}

void putSparseValues(const GltfFile& file, const tinygltf::Accessor& accessor, int components,
                     std::vector<float>& numbers, const SourceLocation& where) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        throw InputError(where, "negative count or offset of sparse values");
    const std::size_t size = checkedComponentSize(accessor.componentType, where);
    const ElementRange indices =
        locate(file, sparse.indices.bufferView, sparse.indices.byteOffset, sparse.count,
               checkedComponentSize(sparse.indices.componentType, where), where);
    const ElementRange values = locate(file, sparse.values.bufferView, sparse.values.byteOffset,
                                       sparse.count, components * size, where);
    for (int i = 0; i < sparse.count; ++i) {
        const double index = loadNumber(indices.element(i), sparse.indices.componentType, false);
        if (!(index >= 0) || index >= static_cast<double>(accessor.count))
            throw InputError(where, fmt::format("sparse index {} is out of range", index));
        for (int c = 0; c < components; ++c)
            numbers[static_cast<std::size_t>(index) * components + c] =
                static_cast<float>(loadNumber(values.element(i) + c * size, accessor.componentType,
                                              accessor.normalized));
    }
}

}  // namespace

std::vector<float> readNumbers(const GltfFile& file, int index, int components,
                               const std::string& element) {
    const SourceLocation where = file.at(element);
    const tinygltf::Accessor& accessor = checkedAccessor(file, index, components, where);
    const std::size_t size = checkedComponentSize(accessor.componentType, where);
    ElementRange range;
    if (accessor.bufferView >= 0)
        range = locate(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                       components * size, where);
    std::vector<float> numbers(accessor.count * components, 0.0f);
    for (std::size_t i = 0; range.data && i < accessor.count; ++i)
        for (int c = 0; c < components; ++c)
            numbers[i * components + c] = static_cast<float>(loadNumber(
                range.element(i) + c * size, accessor.componentType, accessor.normalized));
    if (accessor.sparse.isSparse) putSparseValues(file, accessor, components, numbers, where);
    return numbers;
}

std::vector<Vec3> readVec3s(const GltfFile& file, int accessor, const std::string& element) {
    const std::vector<float> numbers = readNumbers(file, accessor, 3, element);
    std::vector<Vec3> vectors(numbers.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    return vectors;
}

std::vector<Vec2> readVec2s(const GltfFile& file, int accessor, const std::string& element) {
    const std::vector<float> numbers = readNumbers(file, accessor, 2, element);
    std::vector<Vec2> vectors(numbers.size() / 2);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = {numbers[2 * i], numbers[2 * i + 1]};
    return vectors;
}

std::vector<std::uint32_t> readIndices(const GltfFile& file, int index, std::size_t limit,
                                       const std::string& element) {
    const SourceLocation where = file.at(element);
    const tinygltf::Accessor& accessor = checkedAccessor(file, index, 1, where);
    const std::size_t size = checkedComponentSize(accessor.componentType, where);
    const ElementRange range =
        locate(file, accessor.bufferView, accessor.byteOffset, accessor.count, size, where);
    std::vector<std::uint32_t> indices(accessor.count);
    for (std::size_t i = 0; i < accessor.count; ++i) {
        const double value = loadNumber(range.element(i), accessor.componentType, false);
        if (!(value >= 0) || value >= static_cast<double>(limit))
            throw InputError(where, fmt::format("index {} is out of range: there are {} vertices",
                                                value, limit));
        indices[i] = static_cast<std::uint32_t>(value);
    }
    return indices;
}

GltfBytes imageBytes(const GltfFile& file, int index) {
    const GltfImage& image = file.images[index];
    const SourceLocation where = file.at(fmt::format("images[{}]", index));
    if (image.bufferView >= 0) {
        const tinygltf::BufferView& view = checkedView(file, image.bufferView, where);
        const auto begin =
            file.buffers[view.buffer].begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
        return {begin, begin + static_cast<std::ptrdiff_t>(view.byteLength)};
    }
    if (auto bytes = dataUriBytes(image.uri, where)) return std::move(*bytes);
    try {
        return readFileBytes(pathOfUri(file.path, image.uri));
    } catch (const FileError&) {
        return {};
    }
}

}  // namespace vlf
