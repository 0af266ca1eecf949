#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <QImage>
#include <QPoint>
#include <QSize>

#include <vtkNew.h>

#include "ui/view/scene.h"
#include "ui/view/view_camera.h"

class QOpenGLContext;
class QOpenGLExtraFunctions;
class QOpenGLTextureBlitter;
class vtkGenericOpenGLRenderWindow;

namespace arris::ui {

/// All that touches OpenGL: drives VTK in a context that Qt owns. Everything but the constructor
/// and started() needs that context to be current.
class GlCanvas {
 public:
  explicit GlCanvas(Scene& scene);
  ~GlCanvas();
  GlCanvas(const GlCanvas&) = delete;
  GlCanvas& operator=(const GlCanvas&) = delete;

  bool started() const { return context_ != nullptr; }
  /// Takes the current context. After release() it may be called again with another one.
  void start(QOpenGLContext* context);
  void release();

  struct Frame {
    ViewCamera camera;
    QSize pixels;
    double pixel_ratio = 1.0;
    bool coarse = false;  ///< The stand-in for the mesh.
    bool smooth = true;   ///< Several samples for each pixel.
    bool operator==(const Frame&) const = default;
  };
  /// The context draws on the processor.
  bool is_software() const { return software_; }
  /// Draws into VTK's own buffer. Where only lines changed since the last frame they alone are
  /// drawn, over a kept picture of the surface.
  void draw(const Frame& frame);
  /// The same for a picture that is drawn but once: keeps nothing.
  void draw_once(const Frame& frame);
  /// Milliseconds that it took to draw the whole surface; 0: not known yet.
  double surface_time() const { return surface_time_; }
  /// Frames so far for which the surface was drawn, not taken from the kept picture.
  int surfaces_drawn() const { return surfaces_drawn_; }

  /// A picture to lay over the part, premultiplied; `at`: of its top left corner, device pixels.
  struct Layer {
    QImage image;
    QPoint at;
  };
  /// Copies what was drawn into a frame buffer of the same size, opaque, and lays the layers over
  /// it, one after the other.
  void show(const std::vector<Layer>& layers, unsigned int frame_buffer);
  /// What was drawn, premultiplied; null if GL failed.
  QImage read();
  /// Whether the driver has buffers that large.
  bool is_possible(QSize pixels);

 private:
  void prepare(const Frame& frame);
  void render(bool surface, bool lines);
  bool keep_surface(bool restore);
  void release_kept();
  void lay_over(const std::vector<Layer>& layers);

  Scene& scene_;
  QOpenGLContext* context_ = nullptr;
  QOpenGLExtraFunctions* gl_ = nullptr;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  std::unique_ptr<QOpenGLTextureBlitter> blitter_;
  struct Texture {
    unsigned int name = 0;
    qint64 key = 0;  // of the image in it
  };
  std::vector<Texture> textures_;  // of the layers
  double surface_time_ = 0.0;
  int surfaces_drawn_ = 0;
  bool software_ = false;
  QSize size_;

  // A copy of VTK's buffer, colour and depth, before lines are drawn.
  unsigned int kept_buffer_ = 0;
  std::array<unsigned int, 2> kept_parts_{};
  QSize kept_size_;
  int kept_samples_ = 0;
  bool kept_refused_ = false;  // by the driver
  bool kept_valid_ = false;
  Frame kept_frame_;
  std::uint64_t kept_version_ = 0;
};

}  // namespace arris::ui
