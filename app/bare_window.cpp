// The least program with a window: GLFW, OpenGL 4.1 and Dear ImGui with one line of text. `patina bench
// start` holds the editor's start against it. Usage: patina_bare_window WIDTH HEIGHT FILE; writes when its
// first frame was shown.
#define GLFW_INCLUDE_NONE  // the functions come from epoxy
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>

#ifndef _WIN32
#include <sys/resource.h>
#endif

namespace {

double peak_memory_bytes() {
#ifdef _WIN32
    return 0.0;
#else
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return double(usage.ru_maxrss);
#else
    return 1024.0 * double(usage.ru_maxrss);
#endif
#endif
}

void draw_frame(GLFWwindow* window) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    ImGui::Begin("Bare");
    ImGui::TextUnformatted("A window and nothing else.");
    ImGui::End();
    ImGui::Render();
    glClearColor(0.2f, 0.2f, 0.2f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window);
    glFinish();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4 || !glfwInit()) return 1;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    GLFWwindow* window = glfwCreateWindow(std::atoi(argv[1]), std::atoi(argv[2]), "Bare", nullptr, nullptr);
    if (!window) return 1;
    glfwMakeContextCurrent(window);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 410 core");
    draw_frame(window);
    const double at_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    std::ofstream file(argv[3]);
    file << std::fixed << "{\"first_lit_frame\": {\"at_s\": " << at_s
         << ", \"cpu_s\": " << double(std::clock()) / double(CLOCKS_PER_SEC)
         << ", \"peak_memory_bytes\": " << std::setprecision(0) << peak_memory_bytes() << "}}\n";
    if (!file.flush()) return 1;
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwTerminate();
    return 0;
}
