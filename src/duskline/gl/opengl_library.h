#pragma once

namespace duskline::gl {

/// libepoxy ends the program when it finds no libEGL or libOpenGL; these throw UnsupportedOnThisMachine before.
void require_opengl_library();
void require_egl_library();

} // namespace duskline::gl
