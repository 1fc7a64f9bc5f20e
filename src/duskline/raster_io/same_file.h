#pragma once

#include <string>

namespace duskline {

/// Whether two names lead to one existing file: links, other spellings, members of one archive (/vsizip/...).
/// Names that lead nowhere are the same only when they are spelled so.
bool is_same_file(const std::string& a, const std::string& b);

} // namespace duskline
