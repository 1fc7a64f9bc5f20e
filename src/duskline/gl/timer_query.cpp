#include <duskline/gl/timer_query.h>

#include <epoxy/gl.h>

namespace duskline::gl {

void delete_query(unsigned int name)
{
    glDeleteQueries(1, &name);
}

static Handle<delete_query> new_query()
{
    GLuint name = 0;
    glGenQueries(1, &name);
    return Handle<delete_query>(name);
}

TimerQuery::TimerQuery() : query_(new_query()) {}

void TimerQuery::begin() const
{
    glBeginQuery(GL_TIME_ELAPSED, query_.name());
}

void TimerQuery::end() const
{
    glEndQuery(GL_TIME_ELAPSED);
}

std::optional<double> TimerQuery::milliseconds() const
{
    GLint there = GL_FALSE;
    glGetQueryObjectiv(query_.name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (there != GL_TRUE)
        return std::nullopt;
    return wait_for_milliseconds();
}

double TimerQuery::wait_for_milliseconds() const
{
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-6;
}

} // namespace duskline::gl
