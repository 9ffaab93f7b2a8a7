// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/collection/frame_controller.h"

#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/stage/stage.h"
#include "app/session/session.h"
#include "widgets/browse/time_bar.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

/// Between the frames that are played, ms; longer if reading takes longer.
constexpr int kPlayInterval = 200;

}  // namespace

FrameController::FrameController(const Workbench& bench)
    : QObject(&bench.owner), bench_(bench), bar_(new TimeBar(&bench.frame)) {
  bench.frame.addLine(Line::Time, bar_);
  addCommands();
  timer_.setSingleShot(true);
  timer_.setInterval(kPlayInterval);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (is_playing_) step(1);
  });
  connect(bar_, &TimeBar::frameChosen, this, [this](int frame) {
    setPlaying(false);
    open(frame);
  });
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) show();
  });
  show();
}

bool FrameController::isSequence() const {
  return bench_.session.scene() && bench_.session.scene()->sequence.count > 1;
}

void FrameController::addCommands() {
  const auto add = [this](const QString& id, const QString& text, const QString& tip,
                          const QKeySequence& key, std::function<void()> run) {
    return Command{.id = "sequence." + id,
                   .menu = Menu::Views,
                   .text = text,
                   .tip = tip,
                   .keys = {key},
                   .run = std::move(run),
                   .section = section::kFrames,
                   .enabled = [this] { return isSequence(); }};
  };
  bench_.commands.add(add("next", tr("Next frame"), tr("Opens the next frame of the sequence"),
                          tr("Alt+Right"), [this] { step(1); }));
  bench_.commands.add(add("previous", tr("Previous frame"),
                          tr("Opens the frame before in the sequence"), tr("Alt+Left"),
                          [this] { step(-1); }));
  Command play = add("play", tr("Play frames"), tr("Plays the frames of the sequence, or pauses"),
                     tr("Ctrl+Space"), [this] { setPlaying(!is_playing_); });
  play.icon = "play";
  play.checked = [this] { return is_playing_; };
  bar_->setPlayAction(bench_.commands.add(std::move(play)));
}

void FrameController::show() {
  if (!isSequence()) {
    is_playing_ = false;
    bar_->hide();
    return;
  }
  const FrameOfSequence& sequence = bench_.session.scene()->sequence;
  // Whatever is opened is fitted first.
  if (kept_zoom_) bench_.stage.canvas()->setCanvasTransform(*std::exchange(kept_zoom_, {}));
  if (wanted_ < 0) bar_->setFrame(sequence.frame, sequence.count);
  bar_->show();
}

void FrameController::open(int frame) {
  if (!isSequence()) return;
  Session& session = bench_.session;
  wanted_ = frame;
  bench_.opener.reopenFrame(
      frame, [this, &session, frame, view = session.view(), pixel = session.cross_hair()] {
        const ViewCanvas& canvas = *bench_.stage.canvas();
        if (!canvas.isFitted()) kept_zoom_ = canvas.canvasTransform();
        session.set_view(view);
        session.set_cross_hair(pixel);
        if (wanted_ == frame) wanted_ = -1;
        if (is_playing_) timer_.start();
      });
}

void FrameController::step(int step) {
  if (!isSequence()) return;
  const FrameOfSequence& sequence = bench_.session.scene()->sequence;
  const int from = wanted_ >= 0 ? wanted_ : sequence.frame;
  const int count = sequence.count;
  const int frame = is_playing_ ? (from + step) % count : std::clamp(from + step, 0, count - 1);
  if (frame == from) return;
  bar_->setFrame(frame, count);
  open(frame);
}

void FrameController::setPlaying(bool is_playing) {
  is_playing_ = is_playing && isSequence();
  if (is_playing_) step(1);
  bench_.commands.refresh();
}

}  // namespace episcope

#include "moc_frame_controller.cpp"
