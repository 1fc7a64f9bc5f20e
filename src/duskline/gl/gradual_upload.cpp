#include <duskline/gl/gradual_upload.h>

#include <algorithm>

namespace duskline::gl {

GradualUpload::GradualUpload(const TerrainTextures& terrain)
    : shadows_(terrain.field()),
      lines_(static_cast<double>(std::max(terrain.field().rows(), terrain.field().columns()))),
      upload_(terrain.field().rows(), terrain.field().columns()), textures_{upload_.new_texture(),
                                                                            upload_.new_texture()}
{}

void GradualUpload::cast(const DirectionalLight& light)
{
    require_valid(light);
    wanted_ = light;
    is_late_ = true;
    if (shadows_.light())
        return;
    shadows_.begin(light);
    is_late_ = false;
    if (shadows_.advance(shadows_.lines_left()))
        show_finished();
}

void GradualUpload::heights_changed(const CellRectangle&)
{
    is_late_ = shadows_.light().has_value();
}

void GradualUpload::advance(std::chrono::microseconds budget)
{
    if (!shadows_.is_busy()) {
        if (!is_late_)
            return;
        shadows_.begin(wanted_);
        is_late_ = false;
    }
    if (shadows_.advance_for(budget))
        show_finished();
}

void GradualUpload::show_finished()
{
    shown_ = 1 - shown_;
    upload_.upload(shadows_.mask(), textures_.at(shown_));
}

double GradualUpload::done() const
{
    if (shadows_.is_busy())
        return std::min(1.0 - static_cast<double>(shadows_.lines_left()) / lines_, 0.99);
    return is_late_ ? 0.0 : 1.0;
}

} // namespace duskline::gl
