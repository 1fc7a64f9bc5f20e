#pragma once

// CLI11's classes by name, for headers. Who adds options includes <CLI/CLI.hpp>, which makes code in every source that
// it comes to and takes the compiler some six seconds there.
namespace CLI { // NOLINT(readability-identifier-naming): theirs

class App;
class Option;

} // namespace CLI
