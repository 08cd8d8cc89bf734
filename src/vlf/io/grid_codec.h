#pragma once
// Lossless coding of a grid of integer vectors as residuals of a prediction from the neighbours,
// split into byte planes for an entropy coder to follow.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace vlf {

/// Median edge detector of LOCO-I: the median of left, up and left + up - upperLeft (Weinberger,
/// Seroussi, Sapiro, "The LOCO-I Lossless Image Compression Algorithm", IEEE TIP 9(8), 2000).
template <class T>
T predictMedian(T left, T up, T upperLeft) {
    const T low = std::min(left, up), high = std::max(left, up);
    // As low + high = left + up, and without overflow where the sum would.
    return static_cast<T>(low + high - std::clamp(upperLeft, low, high));
}

/// Small differences of either sign, modulo the range of T, as small numbers: 0, -1, 1, -2, ...
template <class T>
T zigzag(T difference) {
    using Signed = std::make_signed_t<T>;
    constexpr int kTop = 8 * sizeof(T) - 1;
    return static_cast<T>(difference << 1) ^
           static_cast<T>(static_cast<Signed>(difference) >> kTop);
}
template <class T>
T unzigzag(T code) {
    return static_cast<T>(code >> 1) ^ static_cast<T>(0 - (code & 1));
}

/// A grid of elements of C integers T, of which the residuals take at most Bytes bytes. The first
/// row is predicted from the left alone, the first column from above alone, the first element
/// from 0. Bytes are stored plane by plane: highest bytes first, and channel by channel therein.
template <class T, int C, int Bytes = sizeof(T)>
struct GridCodec {
    using Element = std::array<T, C>;
    static constexpr std::size_t kElementBytes = C * Bytes;

    static std::vector<std::uint8_t> encode(std::span<const Element> grid, std::size_t width) {
        std::vector<std::uint8_t> planes(grid.size() * kElementBytes);
        for (std::size_t i = 0; i < grid.size(); ++i) {
            const Element prediction = predict(grid.data(), i, i % width, width);
            for (int c = 0; c < C; ++c) {
                const T code = zigzag<T>(grid[i][c] - prediction[c]);
                for (int b = 0; b < Bytes; ++b)
                    planes[plane(b, c) * grid.size() + i] =
                        static_cast<std::uint8_t>(code >> 8 * b);
            }
        }
        return planes;
    }

    /// Precondition: planes.size() == grid.size() * kElementBytes.
    static void decode(std::span<const std::uint8_t> planes, std::span<Element> grid,
                       std::size_t width) {
        for (std::size_t i = 0, x = 0; i < grid.size(); ++i) {
            const Element prediction = predict(grid.data(), i, x, width);
            for (int c = 0; c < C; ++c) {
                T code = 0;
                for (int b = 0; b < Bytes; ++b)
                    code |= static_cast<T>(T{planes[plane(b, c) * grid.size() + i]} << 8 * b);
                grid[i][c] = static_cast<T>(prediction[c] + unzigzag<T>(code));
            }
            if (++x == width) x = 0;
        }
    }

  private:
    static constexpr std::size_t plane(int byte, int channel) {
        return static_cast<std::size_t>(Bytes - 1 - byte) * C + channel;
    }

    static Element predict(const Element* grid, std::size_t i, std::size_t x, std::size_t width) {
        if (i < width) return x == 0 ? Element{} : grid[i - 1];
        if (x == 0) return grid[i - width];
        Element prediction;
        for (int c = 0; c < C; ++c)
            prediction[c] =
                predictMedian<T>(grid[i - 1][c], grid[i - width][c], grid[i - width - 1][c]);
        return prediction;
    }
};

}  // namespace vlf
