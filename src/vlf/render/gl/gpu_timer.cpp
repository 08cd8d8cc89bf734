#include "vlf/render/gl/gpu_timer.h"

namespace vlf::gl {

GpuTimer::GpuTimer() {
    for (Query& query : queries_) query = makeQuery(GL_TIME_ELAPSED);
}

void GpuTimer::begin() {
    collect();
    if (begun_ - collected_ == kQueries) return;
    glBeginQuery(GL_TIME_ELAPSED, queries_[begun_++ % kQueries].id());
    running_ = true;
}

void GpuTimer::end() {
    if (running_) glEndQuery(GL_TIME_ELAPSED);
    running_ = false;
}

std::optional<double> GpuTimer::milliseconds() {
    if (!running_) collect();
    return milliseconds_;
}

void GpuTimer::collect() {
    for (; collected_ < begun_; ++collected_) {
        const GLuint query = queries_[collected_ % kQueries].id();
        GLint available = GL_FALSE;
        glGetQueryObjectiv(query, GL_QUERY_RESULT_AVAILABLE, &available);
        if (!available) return;
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
        milliseconds_ = 1e-6 * static_cast<double>(nanoseconds);
    }
}

}  // namespace vlf::gl
