#include "ui/view/gl_canvas.h"

#include <algorithm>

#include <QElapsedTimer>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLTextureBlitter>

#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>

namespace arris::ui {
namespace {

constexpr int samples_per_pixel = 4;
constexpr qint64 most_sampled_pixels = 20'000'000;  // memory: 32 bytes each

// Desktop enumerators that Qt's headers, made for OpenGL ES too, leave out.
constexpr GLenum depth_component_32 = 0x81A7;

/// VTK asks for the context through an event; QOpenGLWidget::makeCurrent() would rebind Qt's frame
/// buffer under VTK's state cache.
void make_current(vtkObject*, unsigned long, void* context, void*) {
  auto* gl_context = static_cast<QOpenGLContext*>(context);
  if (QOpenGLContext::currentContext() != gl_context && gl_context->surface() != nullptr) {
    gl_context->makeCurrent(gl_context->surface());
  }
}

/// A depth format that can be copied from the frame buffer bound for reading.
GLenum depth_format(QOpenGLExtraFunctions& gl) {
  const auto parameter = [&](GLenum name) {
    GLint value = 0;
    gl.glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, name,
                                             &value);
    return value;
  };
  const GLint bits = parameter(GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  const bool floating = parameter(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
  if (parameter(GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0) {
    return floating ? GL_DEPTH32F_STENCIL8 : GL_DEPTH24_STENCIL8;
  }
  if (floating) return GL_DEPTH_COMPONENT32F;
  return bits <= 16 ? GL_DEPTH_COMPONENT16 : bits <= 24 ? GL_DEPTH_COMPONENT24 : depth_component_32;
}

}  // namespace

GlCanvas::GlCanvas(Scene& scene) : scene_(scene) {
  window_->SetMultiSamples(samples_per_pixel);
  window_->SetNumberOfLayers(2);
  window_->AddRenderer(scene_.surface_renderer());
  window_->AddRenderer(scene_.line_renderer());
}

GlCanvas::~GlCanvas() = default;

void GlCanvas::start(QOpenGLContext* context) {
  context_ = context;
  gl_ = context->extraFunctions();
  window_->RemoveObservers(vtkCommand::WindowMakeCurrentEvent);
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(make_current);
  observer->SetClientData(context);
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, observer);
  window_->SetReadyForRendering(true);
  window_->SetMapped(1);
  window_->SetIsCurrent(true);
  window_->SetSupportsOpenGL(1);
  window_->SetOwnContext(0);
  window_->SetFrameBlitModeToNoBlit();
  window_->OpenGLInitContext();
  window_->GetState()->Reset();
  window_->GetState()->vtkglEnable(GL_DEPTH_TEST);
  window_->GetState()->vtkglDepthFunc(GL_LEQUAL);
  window_->OpenGLInit();
  const auto* name = reinterpret_cast<const char*>(gl_->glGetString(GL_RENDERER));
  const QByteArray renderer = QByteArray(name == nullptr ? "" : name).toLower();
  software_ = renderer.contains("llvmpipe") || renderer.contains("softpipe") ||
              renderer.contains("software") || renderer.contains("swr");
  blitter_ = std::make_unique<QOpenGLTextureBlitter>();
  if (!blitter_->create()) blitter_.reset();
  kept_valid_ = false;
  kept_refused_ = false;
}

void GlCanvas::release() {
  if (!started()) return;
  release_kept();
  for (const Texture& texture : textures_) gl_->glDeleteTextures(1, &texture.name);
  textures_.clear();
  if (blitter_) blitter_->destroy();
  blitter_.reset();
  window_->Finalize();
  window_->SetReadyForRendering(false);
  context_ = nullptr;
  gl_ = nullptr;
}

void GlCanvas::prepare(const Frame& frame) {
  size_ = frame.pixels;
  const bool fits = static_cast<qint64>(size_.width()) * size_.height() <= most_sampled_pixels;
  window_->SetMultiSamples(frame.smooth && fits ? samples_per_pixel : 0);
  window_->SetSize(size_.width(), size_.height());
  scene_.prepare(frame.camera, frame.pixels, frame.pixel_ratio, frame.coarse);
}

void GlCanvas::render(bool surface, bool lines) {
  scene_.surface_renderer()->SetDraw(surface);
  scene_.line_renderer()->SetDraw(lines);
  vtkOpenGLState* state = window_->GetState();
  state->Reset();
  state->Push();
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);
  window_->Render();
  window_->GetShaderCache()->ReleaseCurrentShader();
  state->Pop();
}

void GlCanvas::draw_once(const Frame& frame) {
  prepare(frame);
  render(true, true);
}

void GlCanvas::draw(const Frame& frame) {
  prepare(frame);
  const bool restored = kept_valid_ && kept_frame_ == frame &&
                        kept_version_ == scene_.surface_version() && keep_surface(true);
  if (!restored) {
    const bool uploads = kept_version_ != scene_.surface_version();
    QElapsedTimer clock;
    clock.start();
    render(true, false);
    gl_->glFinish();
    ++surfaces_drawn_;
    // Orbiting draws and does not upload; to a graphics card that takes the longer time of the two.
    if (!frame.coarse && (software_ || !uploads))
      surface_time_ = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    kept_frame_ = frame;
    kept_version_ = scene_.surface_version();
    kept_valid_ = keep_surface(false);
  }
  render(false, true);
}

bool GlCanvas::keep_surface(bool restore) {
  if (kept_refused_) return false;
  while (gl_->glGetError() != GL_NO_ERROR) {
  }
  const GLuint source = window_->GetRenderFramebuffer()->GetFBOIndex();
  gl_->glBindFramebuffer(GL_FRAMEBUFFER, source);
  GLint samples = 0;
  gl_->glGetIntegerv(GL_SAMPLES, &samples);
  if (kept_buffer_ == 0 || kept_size_ != size_ || kept_samples_ != samples) {
    if (restore) return false;
    release_kept();
    kept_size_ = size_;
    kept_samples_ = samples;
    const GLenum depth = depth_format(*gl_);
    const bool stencil = depth == GL_DEPTH24_STENCIL8 || depth == GL_DEPTH32F_STENCIL8;
    gl_->glGenFramebuffers(1, &kept_buffer_);
    gl_->glGenRenderbuffers(2, kept_parts_.data());
    gl_->glBindFramebuffer(GL_FRAMEBUFFER, kept_buffer_);
    const std::array<std::array<GLenum, 2>, 2> parts{
        {{GL_COLOR_ATTACHMENT0, GL_RGBA8},
         {stencil ? GLenum{GL_DEPTH_STENCIL_ATTACHMENT} : GLenum{GL_DEPTH_ATTACHMENT}, depth}}};
    for (std::size_t k = 0; k < parts.size(); ++k) {
      gl_->glBindRenderbuffer(GL_RENDERBUFFER, kept_parts_[k]);
      gl_->glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, parts[k][1], size_.width(),
                                            size_.height());
      gl_->glFramebufferRenderbuffer(GL_FRAMEBUFFER, parts[k][0], GL_RENDERBUFFER, kept_parts_[k]);
    }
    gl_->glBindRenderbuffer(GL_RENDERBUFFER, 0);
  }
  gl_->glDisable(GL_SCISSOR_TEST);
  gl_->glBindFramebuffer(GL_READ_FRAMEBUFFER, restore ? kept_buffer_ : source);
  gl_->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, restore ? source : kept_buffer_);
  gl_->glBlitFramebuffer(0, 0, size_.width(), size_.height(), 0, 0, size_.width(), size_.height(),
                         GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  kept_refused_ = gl_->glGetError() != GL_NO_ERROR;
  return !kept_refused_;
}

void GlCanvas::release_kept() {
  kept_valid_ = false;
  if (kept_buffer_ == 0) return;
  gl_->glDeleteFramebuffers(1, &kept_buffer_);
  gl_->glDeleteRenderbuffers(2, kept_parts_.data());
  kept_buffer_ = 0;
}

void GlCanvas::show(const std::vector<Layer>& layers, unsigned int frame_buffer) {
  gl_->glDisable(GL_SCISSOR_TEST);
  gl_->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_->glBindFramebuffer(GL_READ_FRAMEBUFFER, window_->GetDisplayFramebuffer()->GetFBOIndex());
  gl_->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame_buffer);
  gl_->glBlitFramebuffer(0, 0, size_.width(), size_.height(), 0, 0, size_.width(), size_.height(),
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_->glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
  gl_->glViewport(0, 0, size_.width(), size_.height());
  // Only alpha: what VTK leaves there would make grabbed pictures transparent.
  gl_->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  gl_->glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  gl_->glClear(GL_COLOR_BUFFER_BIT);
  gl_->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  lay_over(layers);
  gl_->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void GlCanvas::lay_over(const std::vector<Layer>& layers) {
  if (!blitter_) return;
  gl_->glActiveTexture(GL_TEXTURE0);
  gl_->glDisable(GL_DEPTH_TEST);
  gl_->glDisable(GL_CULL_FACE);
  gl_->glEnable(GL_BLEND);
  gl_->glBlendEquation(GL_FUNC_ADD);
  gl_->glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // premultiplied
  textures_.resize(std::max(textures_.size(), layers.size()));
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const QImage& image = layers[k].image;
    Texture& texture = textures_[k];
    if (image.isNull()) continue;
    if (texture.name == 0) gl_->glGenTextures(1, &texture.name);
    gl_->glBindTexture(GL_TEXTURE_2D, texture.name);
    if (texture.key != image.cacheKey()) {
      texture.key = image.cacheKey();
      gl_->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      gl_->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
      gl_->glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
      gl_->glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width(), image.height(), 0, GL_RGBA,
                        GL_UNSIGNED_BYTE, image.constBits());
    }
    blitter_->bind();
    blitter_->blit(texture.name,
                   QOpenGLTextureBlitter::targetTransform(QRectF(layers[k].at, image.size()),
                                                          QRect(QPoint(), size_)),
                   QOpenGLTextureBlitter::OriginTopLeft);
    blitter_->release();
  }
  gl_->glBindTexture(GL_TEXTURE_2D, 0);
}

QImage GlCanvas::read() {
  QImage image(size_, QImage::Format_RGBA8888_Premultiplied);
  if (image.isNull()) return {};
  while (gl_->glGetError() != GL_NO_ERROR) {
  }
  gl_->glBindFramebuffer(GL_READ_FRAMEBUFFER, window_->GetDisplayFramebuffer()->GetFBOIndex());
  gl_->glPixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_->glReadPixels(0, 0, size_.width(), size_.height(), GL_RGBA, GL_UNSIGNED_BYTE, image.bits());
  if (gl_->glGetError() != GL_NO_ERROR) return {};
  return image.mirrored();
}

bool GlCanvas::is_possible(QSize pixels) {
  GLint side = 0;
  gl_->glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
  GLint buffer = 0;
  gl_->glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
  std::array<GLint, 2> viewport{};
  gl_->glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  const int most = std::min({side, buffer, viewport[0], viewport[1]});
  return !pixels.isEmpty() && pixels.width() <= most && pixels.height() <= most;
}

}  // namespace arris::ui
