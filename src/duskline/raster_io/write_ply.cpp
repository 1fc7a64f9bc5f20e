// Terrain as a mesh of triangles, in the Stanford triangle format.
//
//      v0---v1     vertices are cells with data, numbered row by row;
//      |   / |     triangles v0 v2 v1 and v1 v2 v3
//      |  /  |
//      v2---v3
//
// Source: Turk, The PLY polygon file format, 1994.

#include <duskline/geometry/invalid_input.h>
#include <duskline/raster_io/staged_output.h>
#include <duskline/raster_io/write_ply.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <span>

namespace duskline {

namespace {

static_assert(std::endian::native == std::endian::little, "PLY files are written as memory has them");

constexpr std::int32_t kNoVertex = -1;

// Bytes of one row after the other.
class Bytes {
public:
    void clear() { bytes_.clear(); }

    template <typename T>
    void add(T value)
    {
        const std::size_t size = bytes_.size();
        bytes_.resize(size + sizeof(T));
        std::memcpy(bytes_.data() + size, &value, sizeof(T));
    }

    void write_to(std::ostream& file) const
    {
        file.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    }

private:
    std::vector<char> bytes_;
};

struct Counts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
};

bool is_square(GridView<const float> heights_m, std::size_t y, std::size_t x)
{
    return !std::isnan(heights_m(y, x) + heights_m(y, x + 1) + heights_m(y + 1, x) + heights_m(y + 1, x + 1));
}

Counts count(GridView<const float> heights_m)
{
    Counts counts;
    for (std::size_t y = 0; y < heights_m.rows(); ++y)
        for (std::size_t x = 0; x < heights_m.columns(); ++x) {
            counts.vertices += std::isnan(heights_m(y, x)) ? 0U : 1U;
            if (y + 1 < heights_m.rows() && x + 1 < heights_m.columns() && is_square(heights_m, y, x))
                counts.triangles += 2;
        }
    return counts;
}

std::string header(const PlyMesh& mesh, const Counts& counts)
{
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : mesh.comments)
        text += "comment " + comment + "\n";
    text += "element vertex " + std::to_string(counts.vertices) + "\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
        text += std::string("property float ") + name + "\n";
    for (const char* name : {"red", "green", "blue"})
        text += std::string("property uchar ") + name + "\n";
    text += "element face " + std::to_string(counts.triangles) + "\nproperty list uchar int vertex_indices\n";
    return text + "end_header\n";
}

void add_vertices(const PlyMesh& mesh, std::size_t y, Bytes& bytes)
{
    const HeightField& field = mesh.field;
    const auto from_centre = [](std::size_t cell, std::size_t cells) {
        return static_cast<double>(cell) - (static_cast<double>(cells) - 1.0) / 2.0;
    };
    const double north_m = -from_centre(y, field.rows()) * field.cell_size_m.y;
    for (std::size_t x = 0; x < field.columns(); ++x) {
        const float height_m = field.heights_m(y, x);
        if (std::isnan(height_m))
            continue;
        bytes.add(static_cast<float>(from_centre(x, field.columns()) * field.cell_size_m.x));
        bytes.add(static_cast<float>(north_m));
        bytes.add(static_cast<float>(height_m + mesh.base_m));
        bytes.add(mesh.normals.east(y, x));
        bytes.add(mesh.normals.north(y, x));
        bytes.add(mesh.normals.up(y, x));
        for (const std::uint8_t colour : mesh.colours(y, x))
            bytes.add(colour);
    }
}

// The numbers of a row's vertices, from `first` on; returns the next.
std::int32_t number_vertices(std::span<const float> heights_m, std::int32_t first,
                             std::vector<std::int32_t>& numbers)
{
    for (std::size_t x = 0; x < heights_m.size(); ++x)
        numbers[x] = std::isnan(heights_m[x]) ? kNoVertex : first++;
    return first;
}

void add_triangles(const std::vector<std::int32_t>& upper, const std::vector<std::int32_t>& lower,
                   Bytes& bytes)
{
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        bytes.add(std::uint8_t{3});
        bytes.add(a);
        bytes.add(b);
        bytes.add(c);
    };
    for (std::size_t x = 0; x + 1 < upper.size(); ++x) {
        if (upper[x] == kNoVertex || upper[x + 1] == kNoVertex || lower[x] == kNoVertex
            || lower[x + 1] == kNoVertex)
            continue;
        add(upper[x], lower[x], upper[x + 1]);
        add(upper[x + 1], lower[x], lower[x + 1]);
    }
}

// The file, and what is said when it cannot be written.
class PlyFile {
public:
    PlyFile(const StagedOutput& staged, const ProgressCallback& progress, std::size_t rows)
        : staged_(staged), file_(staged.path(), std::ios::binary), progress_(progress),
          steps_(2.0 * static_cast<double>(rows))
    {}

    void write(const std::string& text)
    {
        file_ << text;
        require_written();
    }

    void write_row(const Bytes& bytes)
    {
        bytes.write_to(file_);
        require_written();
        done_ += 1.0;
        if (progress_ && !progress_(done_ / steps_))
            throw Cancelled();
    }

    void close()
    {
        file_.close();
        require_written();
    }

private:
    void require_written() const
    {
        if (!file_)
            throw OutputError("cannot write '" + staged_.target() + "': " + std::strerror(errno));
    }

    const StagedOutput& staged_;
    std::ofstream file_;
    const ProgressCallback& progress_;
    double steps_;
    double done_ = 0.0;
};

void require_sizes(const PlyMesh& mesh)
{
    const auto fits = [&](std::size_t rows, std::size_t columns) {
        return rows == mesh.field.rows() && columns == mesh.field.columns();
    };
    if (!fits(mesh.normals.rows(), mesh.normals.columns())
        || !fits(mesh.colours.rows(), mesh.colours.columns()))
        throw InvalidInput("normals and colours of a mesh must have the size of its heights, "
                           + std::to_string(mesh.field.rows()) + " x "
                           + std::to_string(mesh.field.columns()));
}

} // namespace

void require_writable_ply(const std::string& path, const HeightFile& like, bool overwrite)
{
    if (like.is_made_of(path))
        throw OutputError("cannot write '" + path + "': it is the input '" + like.facts().path + "'");
    if (path.starts_with("/vsi"))
        throw OutputError("cannot write '" + path + "': a mesh goes to an ordinary file");
    const StagedOutput trial(path, overwrite);
}

void write_ply(const std::string& path, const HeightFile& like, const PlyMesh& mesh, bool overwrite,
               const ProgressCallback& progress)
{
    require_valid(mesh.field);
    require_sizes(mesh);
    const GridView<const float> heights_m = mesh.field.heights_m;
    const Counts counts = count(heights_m);
    if (counts.vertices > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw InvalidInput("a mesh can have at most 2147483647 vertices, got "
                           + std::to_string(counts.vertices) + "; a smaller raster has fewer");
    require_writable_ply(path, like, overwrite);
    StagedOutput staged(path, overwrite);
    PlyFile file(staged, progress, heights_m.rows());
    file.write(header(mesh, counts));
    Bytes bytes;
    for (std::size_t y = 0; y < heights_m.rows(); ++y) {
        bytes.clear();
        add_vertices(mesh, y, bytes);
        file.write_row(bytes);
    }
    std::vector<std::int32_t> upper(heights_m.columns(), kNoVertex);
    std::vector<std::int32_t> lower(heights_m.columns(), kNoVertex);
    std::int32_t next = 0;
    for (std::size_t y = 0; y < heights_m.rows(); ++y) {
        next = number_vertices(heights_m.row(y), next, lower);
        bytes.clear();
        add_triangles(upper, lower, bytes);
        file.write_row(bytes);
        upper.swap(lower);
    }
    file.close();
    staged.publish();
}

} // namespace duskline
