# The warnings of our own builds, carried by one target so that they never reach a consumer. Without
# -Wnull-dereference: with -O3, g++ 12 sees some in std::string where none are.
add_library(duskline_warnings INTERFACE)
target_compile_options(duskline_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wunused -Wformat=2
  $<$<BOOL:${DUSKLINE_WARNINGS_AS_ERRORS}>:-Werror>)
