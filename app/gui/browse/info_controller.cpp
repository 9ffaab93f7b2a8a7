// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/info_controller.h"

#include "app/gui/browse/conventions_dialog.h"
#include "app/gui/browse/scene_info.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/opening/remembered_conventions.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/stage/stage.h"
#include "app/session/session.h"
#include "engine/io/open/reader.h"
#include "engine/io/order/order_check.h"
#include "widgets/browse/info_panel.h"
#include "widgets/style/theme.h"

#include <QAction>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

namespace episcope {
namespace {

// The options that a reader of the input knows; of one that nobody reads, all but the focus plane.
std::vector<ParameterDescription> options_of(const QString& input, const std::string& reader_id) {
  const io::Reader* reader = io::reader_named(reader_id);
  try {
    if (!reader) reader = io::find_reader(input.toStdString(), {}).reader;
  } catch (const std::exception&) {
    reader = nullptr;  // it could not be opened either
  }
  std::vector<ParameterDescription> options = io::open_schema().descriptions();
  std::erase_if(options, [reader](const ParameterDescription& option) {
    return option.key == Reading::kFocus || (reader && !reader->has_option(option.key));
  });
  return options;
}

}  // namespace

InfoController::InfoController(const Workbench& bench)
    : QObject(&bench.owner), bench_(bench), panel_(new InfoPanel(&bench.frame)), gpu_job_(this) {
  panel_->setContentsMargins(theme::kSpacing, 0, theme::kSpacing, theme::kSpacing);
  bench.frame.addToColumn(panel_, true);
  QAction* conventions = bench.commands.add(
      {.id = "file.conventions",
       .menu = Menu::File,
       .text = tr("Conventions…"),
       .tip = tr("Overrides the order of views, the units or the file names that were found"),
       .keys = {tr("Ctrl+Shift+R")},
       .run = [this] { askForConventions(); },
       .section = section::kOpen,
       .enabled = [this] { return !bench_.opener.reopenable().isEmpty(); }});
  panel_->setConventionsAction(conventions);
  reverse_ = bench.commands.add(
      {.id = "file.reverse_sign",
       .menu = Menu::File,
       .text = tr("Reverse near and far"),
       .tip = tr("Reverses the order of views along both axes: what was near is far"),
       .run = [this] { reverseSign(); },
       .section = section::kOpen,
       .enabled = [this] { return canReverseSign(); }});
  connect(&bench.stage, &Stage::previewChanged, this, &InfoController::show);
  connect(&bench.opener, &SceneOpener::changed, &bench.commands, &Commands::refresh);
  bench.session.on_changed([this](Parts parts) {
    if (!parts.has(Part::Scene)) return;
    show();
    if (bench_.session.scene()) askForGpu();
  });
  show();
}

// The first question starts the driver, which may take a second.
void InfoController::askForGpu() {
  gpu_job_.start<CudaDevice>([question = question_](const Progress&) { return question(); },
                             [this](const CudaDevice& device) {
                               gpu_ = device;
                               show();
                             });
}

void InfoController::show() {
  if (const auto& scene = bench_.session.scene()) {
    SceneInfo info = describe(*scene, gpu_);
    const auto sign = std::ranges::find(info.rows, QString("sign"), &InfoRow::id);
    if (sign != info.rows.end() && canReverseSign()) sign->action = reverse_;
    panel_->setInfo(info.title, info.rows, info.warnings);
  } else {
    panel_->setInfo(bench_.stage.isPreviewing() ? tr("Opening …") : tr("Nothing is open"), {}, {});
  }
}

bool InfoController::canReverseSign() const {
  return bench_.session.scene() && !is_builtin(QString::fromStdString(bench_.session.input()));
}

void InfoController::reverseSign() {
  const ConventionReport& report = bench_.session.scene()->convention;
  io::OpenOptions options = io::open_schema().parse(bench_.session.reading_options());
  options.flip = io::flip_choice({!report.reversed_u, !report.reversed_v});
  bench_.opener.reopenShownWith(io::given_options(options));
}

void InfoController::askForConventions() {
  SceneOpener& opener = bench_.opener;
  const QString input = opener.reopenable();
  if (input.isEmpty()) return;
  const std::string reader =
      opener.hasFailed() ? std::string() : bench_.session.light_field()->info().reading.reader;
  auto* dialog = new ConventionsDialog(input, options_of(input, reader),
                                       remembered_conventions(input), &bench_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [dialog, input, &opener] {
    // Something else may have been opened meanwhile, by a drop.
    if (opener.reopenable() == input) opener.reopenWith(dialog->given());
  });
  dialog->open();
}

}  // namespace episcope

#include "moc_info_controller.cpp"
