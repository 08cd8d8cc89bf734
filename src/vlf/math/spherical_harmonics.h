#pragma once
// Real spherical harmonics of up to order 5, as polynomials in the direction.
//
// Order n means the bands l = 0..n-1, n² functions Y_lm; function l² + l + m is Y_lm, without the
// Condon-Shortley phase: Y_1 = 0.4886 (y, z, x). Orthonormal over the sphere.

#include "vlf/math/pose.h"
#include "vlf/math/vector.h"

#include <array>

namespace vlf {

inline constexpr int kMaxShOrder = 5;
inline constexpr int kMaxShCount = kMaxShOrder * kMaxShOrder;

constexpr int shCount(int order) {
    return order * order;
}

/// Band l of function i.
constexpr int shBand(int i) {
    int band = 0;
    while (shCount(band + 1) <= i) ++band;
    return band;
}

/// One coefficient or value per function. Those beyond an order in use are zero.
template <class Value>
using Sh = std::array<Value, kMaxShCount>;

/// All functions at the unit vector (x, y, z). `T` is float, or a register of floats.
template <class T>
inline void evaluateSh(const T& x, const T& y, const T& z, T* out) {
    const T xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, xz = x * z;
    const T difference = xx - yy;                              // cos 2φ sin²θ
    const T cosine3 = xx - 3.0f * yy, sine3 = 3.0f * xx - yy;  // of 3φ, but for x and y
    const T five = 5.0f * zz - 1.0f, seven = 7.0f * zz - 1.0f, sevenThree = 7.0f * zz - 3.0f;
    out[0] = 0.0f * x + 0.28209479177f;
    out[1] = 0.48860251190f * y;
    out[2] = 0.48860251190f * z;
    out[3] = 0.48860251190f * x;
    out[4] = 1.09254843059f * xy;
    out[5] = 1.09254843059f * yz;
    out[6] = 0.31539156525f * (3.0f * zz - 1.0f);
    out[7] = 1.09254843059f * xz;
    out[8] = 0.54627421530f * difference;
    out[9] = 0.59004358993f * y * sine3;
    out[10] = 2.89061144264f * xy * z;
    out[11] = 0.45704579946f * y * five;
    out[12] = 0.37317633259f * z * (5.0f * zz - 3.0f);
    out[13] = 0.45704579946f * x * five;
    out[14] = 1.44530572132f * z * difference;
    out[15] = 0.59004358993f * x * cosine3;
    out[16] = 2.50334294180f * xy * difference;
    out[17] = 1.77013076978f * yz * sine3;
    out[18] = 0.94617469576f * xy * seven;
    out[19] = 0.66904654356f * yz * sevenThree;
    out[20] = 0.10578554692f * (zz * (35.0f * zz - 30.0f) + 3.0f);
    out[21] = 0.66904654356f * xz * sevenThree;
    out[22] = 0.47308734788f * difference * seven;
    out[23] = 1.77013076978f * xz * cosine3;
    out[24] = 0.62583573545f * (xx * cosine3 - yy * sine3);
}

/// All functions at unit vector d.
inline Sh<float> shBasis(const Vec3& d) {
    Sh<float> basis;
    evaluateSh(d.x, d.y, d.z, basis.data());
    return basis;
}

/// Value at unit vector d of the function with these coefficients.
template <class Value>
Value shValue(const Sh<Value>& coefficients, const Vec3& d) {
    const Sh<float> basis = shBasis(d);
    Value sum(0);
    for (int i = 0; i < kMaxShCount; ++i) sum += basis[i] * coefficients[i];
    return sum;
}

/// Coefficients of f(direction) by a quadrature of 45 directions (five heights of Gauss and
/// Legendre, nine azimuths), which is exact for polynomials of degree 8: for any f that is itself
/// of order 5.
template <class Function>
auto projectSh(Function f) {
    using Value = decltype(f(Vec3()));
    constexpr std::array<double, 5> kHeights{-0.906179845938664, -0.538469310105683, 0,
                                             0.538469310105683, 0.906179845938664};
    constexpr std::array<double, 5> kWeights{0.236926885056189, 0.478628670499366,
                                             0.568888888888889, 0.478628670499366,
                                             0.236926885056189};
    constexpr int kAzimuths = 9;
    constexpr double kStep = 2 * std::numbers::pi / kAzimuths;
    static const std::array<Vec2, kAzimuths> circle = [] {
        std::array<Vec2, kAzimuths> c;
        for (int j = 0; j < kAzimuths; ++j) c[j] = Vec2(std::cos(j * kStep), std::sin(j * kStep));
        return c;
    }();
    Sh<Value> coefficients{};
    for (std::size_t i = 0; i < kHeights.size(); ++i)
        for (const Vec2& c : circle) {
            const auto radius = static_cast<float>(std::sqrt(1 - kHeights[i] * kHeights[i]));
            const Vec3 d(radius * c.x, radius * c.y, static_cast<float>(kHeights[i]));
            const Sh<float> basis = shBasis(d);
            const Value weighted = static_cast<float>(kWeights[i] * kStep) * f(d);
            for (int k = 0; k < kMaxShCount; ++k) coefficients[k] += basis[k] * weighted;
        }
    return coefficients;
}

/// The function d -> f(rotation⁻¹ d): f turned with a body. Exact; bands do not mix.
template <class Value>
Sh<Value> rotateSh(const Sh<Value>& coefficients, const Quat& rotation) {
    const Quat inverse = glm::conjugate(rotation);
    return projectSh([&](const Vec3& d) { return shValue(coefficients, inverse * d); });
}

/// Radiance becomes irradiance where the coefficients of band l are multiplied by these
/// (Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps",
/// SIGGRAPH 2001).
inline constexpr std::array<float, kMaxShOrder> kCosineLobe{kPi, 2 * kPi / 3, kPi / 4, 0,
                                                            -kPi / 24};

/// Irradiance (W·m⁻²) on a plane with unit normal n in the open, of incident radiance with these
/// coefficients.
template <class Value>
Value shIrradiance(const Sh<Value>& radiance, const Vec3& n) {
    const Sh<float> basis = shBasis(n);
    Value sum(0);
    for (int l = 0, i = 0; l < kMaxShOrder; ++l)
        for (; i < shCount(l + 1); ++i) sum += kCosineLobe[l] * basis[i] * radiance[i];
    return sum;
}

}  // namespace vlf
