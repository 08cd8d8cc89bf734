// A baked room within a program's own window and OpenGL context: embed ROOM.vlf
//
// The host makes the context, decides where pictures go and may draw what it likes before and
// after: Renderer::draw leaves the state as it finds it.

#include <vlf/base/error.h>
#include <vlf/io/field_file.h>
#include <vlf/render/gl/renderer.h>

#include <cmath>
#include <cstdio>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace {

GLFWwindow* openWindow() {
    if (!glfwInit()) throw vlf::Error("no display");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow* window = glfwCreateWindow(800, 600, "embedded room", nullptr, nullptr);
    if (!window) throw vlf::Error("no OpenGL 4.5");
    glfwMakeContextCurrent(window);
    return window;
}

/// Sways to and fro beside where the camera stands.
vlf::Camera swayed(vlf::Camera camera, double seconds) {
    const vlf::Vec3 forward = camera.look - camera.eye;
    const vlf::Vec3 side = glm::normalize(glm::cross(forward, camera.up));
    camera.eye += static_cast<float>(0.1 * std::sin(seconds)) * glm::length(forward) * side;
    return camera;
}

void show(const char* file) {
    const vlf::BakedRoom room = vlf::readField(file);
    const vlf::Camera camera =
        room.scene.cameras.empty() ? vlf::defaultCamera(room.scene) : room.scene.cameras.front();
    GLFWwindow* window = openWindow();
    vlf::Renderer renderer(room.scene, room.field);
    while (!glfwWindowShouldClose(window)) {
        glfwPollEvents();
        int width = 0, height = 0;
        glfwGetFramebufferSize(window, &width, &height);
        if (width > 0 && height > 0)
            renderer.draw(
                vlf::viewOf(swayed(camera, glfwGetTime()), width, height, renderer.nearest()), {},
                0);
        glfwSwapBuffers(window);
    }
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) throw vlf::Error("usage: embed ROOM.vlf");
    show(argv[1]);
    glfwTerminate();
    return 0;
} catch (const vlf::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
