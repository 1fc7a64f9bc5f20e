#pragma once

#include <stdexcept>

namespace duskline {

/// A value the caller gave cannot be used. The text says which, what it was, and what would be right.
class InvalidInput : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// The work needs more memory, or another machine, than there is.
class UnsupportedOnThisMachine : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace duskline
