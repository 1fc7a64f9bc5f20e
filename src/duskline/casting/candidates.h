#pragma once

// The lines that may show in an exact front (exact.cpp, exact_lamp.cpp): remembered by number, unit by unit, and
// compared where too many come together. Not installed.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace duskline {

/// The front where no ground has passed under a beam yet, and what is above it where some has: heights, or a lamp's
/// slopes. Finite: brackets are differences.
inline constexpr float kNoGround = -1.0e30f;
inline constexpr float kSeenGround = -1.0e20f;

/// A bracket that says nothing.
inline constexpr float kWideOpen = 1.0e30f;

/// Two lines closer than this are one: a plane along the light must not keep every line it has.
inline constexpr double kStraight_m = 1e-9;

/// Candidates of a unit beyond which it is worth to look for those that others hide.
inline constexpr std::uint32_t kManyCandidates = 16;

/// A candidate: a line, or the lines across between it and the line before.
struct Candidate {
    static std::uint32_t line(std::size_t v) { return static_cast<std::uint32_t>(v) << 1; }
    static std::uint32_t between(std::size_t v) { return line(v) | 1U; }
    static bool is_between(std::uint32_t id) { return (id & 1U) != 0; }
    static std::size_t number(std::uint32_t id) { return id >> 1; }
};

/// The candidates of all units of a strip, in one piece of memory. A list grows by doubling; what it leaves is
/// given to the next list of that size.
class CandidateLists {
public:
    explicit CandidateLists(std::size_t units) : lists_(units) {}

    /// Candidates since `base`, the line that replaced all before it (below 0: none has), and that line itself.
    std::span<const std::uint32_t> of(std::size_t unit, std::int32_t base)
    {
        renew(unit, base);
        return {memory_.data() + lists_[unit].first, lists_[unit].count};
    }

    void add(std::size_t unit, std::int32_t base, std::uint32_t candidate)
    {
        renew(unit, base);
        push(lists_[unit], candidate);
    }

    /// The same for a candidate that may have been the last one added.
    void add_once(std::size_t unit, std::int32_t base, std::uint32_t candidate)
    {
        renew(unit, base);
        const List& list = lists_[unit];
        if (list.count == 0 || memory_[list.first + list.count - 1] != candidate)
            push(lists_[unit], candidate);
    }

    /// Whether the next candidate would have to move a long list.
    bool is_full(std::size_t unit) const
    {
        return lists_[unit].count >= kManyCandidates && lists_[unit].count == capacity(lists_[unit]);
    }

    void keep_only(std::size_t unit, std::span<const std::uint32_t> candidates)
    {
        std::ranges::copy(candidates, memory_.begin() + lists_[unit].first);
        lists_[unit].count = static_cast<std::uint32_t>(candidates.size());
    }

    /// Takes over what another list's unit holds since `base`.
    void inherit(std::size_t unit, std::int32_t base, const CandidateLists& from, std::size_t from_unit)
    {
        const List& old = from.lists_[from_unit];
        if (old.base != base) // renewed when it is asked for
            return;
        lists_[unit].base = base;
        for (std::uint32_t i = 0; i < old.count; ++i)
            push(lists_[unit], from.memory_[old.first + i]);
    }

private:
    struct List {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
        std::int32_t base = -1;
        std::uint32_t size_class = 0; // 0: no memory yet; else room for 2 << size_class
    };

    static std::uint32_t capacity(const List& list)
    {
        return list.size_class == 0 ? 0 : 2U << list.size_class;
    }

    void renew(std::size_t unit, std::int32_t base)
    {
        List& list = lists_[unit];
        if (list.base == base)
            return;
        list.base = base;
        list.count = 0;
        push(list, Candidate::line(static_cast<std::size_t>(base)));
    }

    void push(List& list, std::uint32_t candidate)
    {
        if (list.count == capacity(list))
            grow(list);
        memory_[list.first + list.count++] = candidate;
    }

    void grow(List& list)
    {
        const std::uint32_t room = 2U << (list.size_class + 1);
        auto& spare = spare_[list.size_class + 1];
        std::uint32_t first = static_cast<std::uint32_t>(memory_.size());
        if (spare.empty()) {
            memory_.resize(memory_.size() + room);
        } else {
            first = spare.back();
            spare.pop_back();
        }
        std::copy_n(memory_.begin() + list.first, list.count, memory_.begin() + first);
        if (list.size_class != 0)
            spare_[list.size_class].push_back(list.first);
        list.first = first;
        ++list.size_class;
    }

    std::vector<List> lists_;
    std::vector<std::uint32_t> memory_;
    std::array<std::vector<std::uint32_t>, 32> spare_;
};

/// The part of a candidate in one unit: heights over places from its one end, 0, to the other, 1.
struct Piece {
    struct Knot {
        double place;
        double height_m;
    };
    std::array<Knot, 3> knots;
    std::size_t count = 0;

    void add(double place, double height_m) { knots[count++] = {place, height_m}; }
    bool covers(double from, double to) const
    {
        return count > 0 && knots[0].place <= from && knots[count - 1].place >= to;
    }
    double at(double place) const
    {
        std::size_t i = 1;
        while (i + 1 < count && knots[i].place < place)
            ++i;
        if (count == 1)
            return knots[0].height_m;
        const Knot& a = knots[i - 1];
        const Knot& b = knots[i];
        const double length = b.place - a.place;
        return length > 0.0 ? a.height_m + (b.height_m - a.height_m) * ((place - a.place) / length)
                            : std::max(a.height_m, b.height_m);
    }
};

/// Whether a piece lies on or under another all over, where one that pokes out by `straight` or less does not count.
inline bool hides(const Piece& hider, const Piece& hidden, double straight)
{
    if (hidden.count == 0)
        return true;
    const double from = hidden.knots[0].place;
    const double to = hidden.knots[hidden.count - 1].place;
    if (!hider.covers(from, to))
        return false;
    const auto hidden_at = [&](double place) { return hider.at(place) >= hidden.at(place) - straight; };
    for (std::size_t i = 0; i < hidden.count; ++i)
        if (!hidden_at(hidden.knots[i].place))
            return false;
    for (std::size_t i = 0; i < hider.count; ++i)
        if (const double place = hider.knots[i].place; place > from && place < to && !hidden_at(place))
            return false;
    return true;
}

} // namespace duskline
