#include "made_raster.h"

#include <duskline/raster_io/write_ply.h>

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

namespace duskline {
namespace {

using namespace raster_test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Rgb = std::array<std::uint8_t, 3>;

// A PLY file as any reader sees it.
struct Ply {
    std::string head;
    struct Vertex {
        std::array<float, 6> place_and_normal;
        Rgb colour;
    };
    std::vector<Vertex> vertices;
    std::vector<std::array<std::int32_t, 3>> triangles;
};

std::size_t count_in(const std::string& head, const std::string& element)
{
    const std::size_t at = head.find("element " + element + " ");
    return at == std::string::npos ? 0 : std::stoul(head.substr(at + 9 + element.size()));
}

Ply parsed(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    Ply ply;
    ply.head = bytes.substr(0, bytes.find("end_header\n") + 11);
    std::size_t at = ply.head.size();
    const auto take = [&](auto& value) {
        ASSERT_LE(at + sizeof(value), bytes.size());
        std::memcpy(&value, bytes.data() + at, sizeof(value));
        at += sizeof(value);
    };
    ply.vertices.resize(count_in(ply.head, "vertex"));
    for (Ply::Vertex& vertex : ply.vertices) {
        take(vertex.place_and_normal);
        take(vertex.colour);
    }
    ply.triangles.resize(count_in(ply.head, "face"));
    for (auto& triangle : ply.triangles) {
        std::uint8_t corners = 0;
        take(corners);
        EXPECT_EQ(corners, 3);
        take(triangle);
    }
    EXPECT_EQ(at, bytes.size());
    return ply;
}

class WritePly : public FolderTest {
protected:
    WritePly() : terrain_{Grid<float>(4, 6), {10.0, 20.0}}, colours_(4, 6)
    {
        for (std::size_t y = 0; y < 4; ++y)
            for (std::size_t x = 0; x < 6; ++x) {
                terrain_.heights_m(y, x) = static_cast<float>(100 * y + 7 * x);
                colours_(y, x) = {static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(x), 9};
            }
    }

    Ply written() const
    {
        const HeightFile like(made({}));
        const NormalField normals = upward_normals(terrain_);
        write_ply(path("mesh.ply"), like,
                  {.field = terrain_, .normals = normals, .colours = colours_.view(), .comments = {"here"}},
                  true);
        return parsed(path("mesh.ply"));
    }

    Terrain terrain_;
    Grid<Rgb> colours_;
};

TEST_F(WritePly, HoldsEveryCellWithItsNormalAndColour)
{
    const Ply ply = written();
    EXPECT_THAT(ply.head,
                HasSubstr("ply\nformat binary_little_endian 1.0\ncomment here\nelement vertex 24\n"));
    ASSERT_EQ(ply.vertices.size(), 24U);
    const Vector3 normal = upward_normal(slope_at(terrain_, 1, 4));
    const auto& vertex = ply.vertices[1 * 6 + 4];
    EXPECT_FLOAT_EQ(vertex.place_and_normal[0], 15.0f);
    EXPECT_FLOAT_EQ(vertex.place_and_normal[1], 10.0f);
    EXPECT_FLOAT_EQ(vertex.place_and_normal[2], 128.0f);
    EXPECT_FLOAT_EQ(vertex.place_and_normal[3], static_cast<float>(normal.x));
    EXPECT_FLOAT_EQ(vertex.place_and_normal[4], static_cast<float>(normal.y));
    EXPECT_FLOAT_EQ(vertex.place_and_normal[5], static_cast<float>(normal.z));
    EXPECT_EQ(vertex.colour, (Rgb{1, 4, 9}));
}

TEST_F(WritePly, TrianglesLookUpAndCoverTheGroundOnce)
{
    const Ply ply = written();
    ASSERT_EQ(ply.triangles.size(), 2U * 3U * 5U);
    double area = 0.0;
    for (const auto& triangle : ply.triangles) {
        const auto corner = [&](std::size_t i) {
            const auto& place = ply.vertices.at(static_cast<std::size_t>(triangle.at(i))).place_and_normal;
            return Vector3{place[0], place[1], place[2]};
        };
        const Vector3 a = corner(1) - corner(0);
        const Vector3 b = corner(2) - corner(0);
        const double twice_from_above = a.x * b.y - a.y * b.x;
        EXPECT_GT(twice_from_above, 0.0);
        area += twice_from_above / 2.0;
    }
    EXPECT_DOUBLE_EQ(area, 5 * 10.0 * 3 * 20.0);
}

TEST_F(WritePly, CellsWithoutDataLeaveHoles)
{
    terrain_.heights_m(1, 2) = std::nanf("");
    const Ply ply = written();
    EXPECT_EQ(ply.vertices.size(), 23U);
    EXPECT_EQ(ply.triangles.size(), 2U * (15U - 4U));
    for (const auto& vertex : ply.vertices)
        for (const float number : vertex.place_and_normal)
            EXPECT_FALSE(std::isnan(number));
    for (const auto& triangle : ply.triangles)
        for (const std::int32_t corner : triangle)
            EXPECT_TRUE(corner >= 0 && corner < 23);
}

TEST_F(WritePly, RefusesWhatItMayNotReplaceAndStopsWhenAsked)
{
    const HeightFile like(made({}));
    const NormalField normals = upward_normals(terrain_);
    const PlyMesh mesh{.field = terrain_, .normals = normals, .colours = colours_.view()};
    EXPECT_THROW(write_ply(path("heights.tif"), like, mesh, true), OutputError);
    EXPECT_THROW(write_ply(path("nowhere/mesh.ply"), like, mesh), OutputError);
    EXPECT_THROW(write_ply(path("mesh.ply"), like, mesh, false, [](double done) { return done < 0.5; }),
                 Cancelled);
    EXPECT_THAT(files(), ElementsAre("heights.tif"));
    write_ply(path("mesh.ply"), like, mesh);
    EXPECT_THROW(write_ply(path("mesh.ply"), like, mesh), OutputError);
    const Grid<Rgb> small(4, 5);
    EXPECT_THROW(
        write_ply(path("other.ply"), like, {.field = terrain_, .normals = normals, .colours = small.view()}),
        InvalidInput);
}

} // namespace
} // namespace duskline
