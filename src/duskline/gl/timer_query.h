#pragma once

#include <duskline/gl/handle.h>

#include <optional>

namespace duskline::gl {

void delete_query(unsigned int name);

/// How long the graphics card was busy between `begin` and `end`. One may run at a time in a context. The answer is
/// there some frames later, so keep a few queries and read the oldest.
class TimerQuery {
public:
    TimerQuery();

    void begin() const;
    void end() const;

    /// Nothing while the card is not yet done.
    std::optional<double> milliseconds() const;
    /// Waits until it is.
    double wait_for_milliseconds() const;

private:
    Handle<delete_query> query_;
};

} // namespace duskline::gl
