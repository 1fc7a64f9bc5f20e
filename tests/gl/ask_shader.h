#pragma once

#include <duskline/gl/buffer.h>
#include <duskline/gl/program.h>

#include <array>
#include <cstddef>
#include <vector>

namespace duskline::gl {

/// What a compute shader with 64 invocations a group says to questions in shader storage 4: so many answers, in 5.
inline std::vector<std::array<float, 4>>
answers_of(const Program& shader, const std::vector<std::array<float, 4>>& asked, std::size_t count)
{
    Buffer questions;
    Buffer replies(count * sizeof(std::array<float, 4>));
    questions.upload(asked);
    questions.bind_as_storage(4);
    replies.bind_as_storage(5);
    dispatch(shader, count);
    return replies.download<std::array<float, 4>>();
}

} // namespace duskline::gl
