// How long a field file takes until it is seen: load_table FIELD [--repeats N]
//
// Seconds, wall and CPU, of each step: reading, layout and packing of the radiance field, all of
// the renderer's copying (which includes these two), the first frame (which compiles shaders).

#include "vlf/io/field_file.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/packed_radiance.h"
#include "vlf/render/gl/renderer.h"
#include "vlf/render/gl/room_geometry.h"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;

constexpr int kWidth = 1024, kHeight = 768;

template <class Step>
auto timed(const char* name, Step step) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpuStart = std::clock();
    auto result = step();
    const double cpu = static_cast<double>(std::clock() - cpuStart) / CLOCKS_PER_SEC;
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    std::printf("%-16s %8.3f s %8.3f CPU s\n", name, wall.count(), cpu);
    return result;
}

bool drawFirstFrame(Renderer& renderer, const BakedRoom& room) {
    const gl::TextureObject color = gl::makeTexture(GL_TEXTURE_2D);
    const gl::TextureObject depth = gl::makeTexture(GL_TEXTURE_2D);
    const gl::Framebuffer framebuffer = gl::makeFramebuffer();
    glTextureStorage2D(color.id(), 1, GL_RGBA8, kWidth, kHeight);
    glTextureStorage2D(depth.id(), 1, GL_DEPTH_COMPONENT24, kWidth, kHeight);
    glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
    glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    const Camera camera =
        room.scene.cameras.empty() ? defaultCamera(room.scene) : room.scene.cameras.front();
    renderer.draw(viewOf(camera, kWidth, kHeight, renderer.nearest()), {}, framebuffer.id());
    glFinish();
    return true;
}

void load(const std::string& path) {
    const BakedRoom room = timed("reading", [&] { return readField(path); });
    const auto charts = makeRoomGeometry(room.scene, room.field).mirrorCharts;
    {
        const RadianceLayout layout =
            timed("layout", [&] { return layOutRadiance(room.field.radiance, charts); });
        timed("packing", [&] { return packRadiance(room.field.radiance, charts, layout); });
    }
    const gl::HeadlessContext context;
    std::optional<Renderer> renderer;
    timed("renderer", [&] { return renderer.emplace(room.scene, room.field).nearest(); });
    timed("first frame", [&] { return drawFirstFrame(*renderer, room); });
}

}  // namespace

int main(int argc, char** argv) {
    std::string field;
    int repeats = 1;
    CLI::App app("How long a field takes until it is seen");
    app.add_option("field", field, "Field file (.vlf)")->required();
    app.add_option("--repeats", repeats);
    CLI11_PARSE(app, argc, argv);
    for (int i = 0; i < repeats; ++i) load(field);
    return 0;
}
