#pragma once
// Which variant of a shader: made anew for every draw call, so it allocates nothing.

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vlf::gl {

/// The name and value of a #define. Texts are not copied: string literals.
struct Define {
    std::string_view name, text;
    int number = 0;  ///< the value, if there is no text

    Define() = default;
    Define(std::string_view name_, const char* text_) : name(name_), text(text_) {}
    Define(std::string_view name_, int number_) : name(name_), number(number_) {}

    std::string value() const { return text.empty() ? std::to_string(number) : std::string(text); }
    auto operator<=>(const Define&) const = default;
};

/// A set of them, in the order of their names.
class Defines {
  public:
    Defines() = default;
    Defines(std::initializer_list<Define> defines) {
        for (const Define& define : defines) add(define);
    }

    /// One of a name that is there already changes nothing. Throws logic_error if there are too
    /// many.
    void add(const Define& define) {
        Define* const place =
            std::lower_bound(items_.data(), items_.data() + count_, define,
                             [](const Define& a, const Define& b) { return a.name < b.name; });
        if (place != items_.data() + count_ && place->name == define.name) return;
        if (count_ == items_.size()) throw std::logic_error("a shader has too many #defines");
        std::copy_backward(place, items_.data() + count_, items_.data() + count_ + 1);
        *place = define;
        ++count_;
    }

    /// Null if there is none.
    const Define* find(std::string_view name) const {
        const Define* const found =
            std::find_if(begin(), end(), [&](const Define& d) { return d.name == name; });
        return found == end() ? nullptr : found;
    }

    const Define* begin() const { return items_.data(); }
    const Define* end() const { return items_.data() + count_; }

    std::strong_ordering operator<=>(const Defines& other) const {
        return std::lexicographical_compare_three_way(begin(), end(), other.begin(), other.end());
    }
    bool operator==(const Defines& other) const {
        return std::equal(begin(), end(), other.begin(), other.end());
    }

  private:
    std::array<Define, 16> items_;
    std::size_t count_ = 0;
};

}  // namespace vlf::gl
