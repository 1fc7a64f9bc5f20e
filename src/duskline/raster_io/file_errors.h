#pragma once

#include <stdexcept>

namespace duskline {

/// A file cannot be used as heights. One line: which file, why, and what would help.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A result cannot be written. One line: which file and why. Nothing of it is left on disk.
class OutputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace duskline
