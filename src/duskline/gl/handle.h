#pragma once

#include <utility>

namespace duskline::gl {

/// Owns one OpenGL object by its name: moves and is not copied. Deletes it when it goes, which needs the context it
/// was made in (or one that shares with it) to be current then. 0 is no object.
template <void (*kDelete)(unsigned int)>
class Handle {
public:
    Handle() = default;
    explicit Handle(unsigned int name) : name_(name) {}
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept
    {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Handle()
    {
        if (name_ != 0)
            kDelete(name_);
    }

    unsigned int name() const { return name_; }

private:
    unsigned int name_ = 0;
};

} // namespace duskline::gl
