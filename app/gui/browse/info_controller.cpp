// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/info_controller.h"

#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/scene_summary.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/parameter.h"
#include "engine/core/scene.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/reader.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/panels/info_panel.h"

#include <QAction>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QString>
#include <QStringList>
#include <QTreeWidget>
#include <QWidget>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <vector>

namespace episcope {
namespace {

/// Shows what a pattern for file names makes of a folder of images: how many match, which grid
/// comes of it, and row and column of each file.
class PatternPanel : public QWidget {
  Q_OBJECT

 public:
  /// `folder` or an image in it.
  PatternPanel(const QString& path, QWidget* parent);

  /// Looks at the folder in the background; only the newest request is shown.
  void preview(const std::string& pattern, bool is_snake);

 private:
  void fill(const io::PatternPreview& preview);

  QString folder_;
  QLabel* summary_;
  QTreeWidget* names_;
  LatestJob job_;
};

constexpr int kListHeight = 110;
constexpr int kNumberWidth = 64;
constexpr int kViewColumn = 4;

QString count_text(const std::optional<long long>& number) {
  return number ? QString::number(*number) : QString();
}

QTreeWidgetItem* make_item(const io::NamePreview& name, const QPalette& palette) {
  const QString view = name.view ? QString("%1,%2").arg(name.view->v).arg(name.view->u) : QString();
  auto* item = new QTreeWidgetItem({QString::fromStdString(name.name), count_text(name.row),
                                    count_text(name.column), count_text(name.index), view});
  item->setToolTip(0, item->text(0));
  if (name.is_match) return item;
  item->setText(kViewColumn, PatternPanel::tr("no match"));
  for (int column = 0; column < item->columnCount(); ++column) {
    item->setForeground(column, theme::muted_text(palette));
  }
  return item;
}

QString summary_of(const io::PatternPreview& preview) {
  const QString problem = breakable(QString::fromStdString(preview.problem));
  if (preview.images == 0) return problem;
  const QString matches =
      PatternPanel::tr("%1 of %2 images match").arg(preview.matches).arg(preview.images);
  if (!preview.problem.empty()) {
    return matches + ": " + problem;
  }
  const QString grid =
      preview.is_list
          ? PatternPanel::tr("a list of %1 views; the images tell its rows").arg(preview.grid.u)
          : PatternPanel::tr("%1×%2 views").arg(preview.grid.v).arg(preview.grid.u);
  QString warnings;
  for (const std::string& warning : preview.warnings) {
    warnings += ". " + breakable(QString::fromStdString(warning));
  }
  return matches + ": " + grid + warnings;
}

io::PatternPreview preview_of(const std::string& folder, const std::string& pattern,
                              bool is_snake) {
  try {
    io::PatternPreview preview = io::preview_pattern(folder, pattern, is_snake);
    if (preview.images == 0) preview.problem = PatternPanel::tr("no images here").toStdString();
    return preview;
  } catch (const Error& error) {
    io::PatternPreview preview;
    preview.problem = error.what();
    return preview;
  }
}

PatternPanel::PatternPanel(const QString& path, QWidget* parent)
    : QWidget(parent),
      folder_(QFileInfo(path).isDir() ? path : QFileInfo(path).absolutePath()),
      summary_(named("pattern.summary", new QLabel(this))),
      names_(named("pattern.names", new QTreeWidget(this))),
      job_(this) {
  auto* help = new QLabel(
      tr("{row} and {col} stand for the numbers of a view, {index} for a running number, {x} and "
         "{y} for positions, * for anything. After re: follows a regular expression, as in "
         "re:view_(?<row>\\d+)_(?<col>\\d+)\\.png."),
      this);
  help->setTextFormat(Qt::PlainText);
  help->setWordWrap(true);
  theme::mute(help);
  summary_->setTextFormat(Qt::PlainText);
  summary_->setWordWrap(true);
  names_->setHeaderLabels({tr("File"), tr("Row"), tr("Column"), tr("Number"), tr("View")});
  names_->setRootIsDecorated(false);
  names_->setUniformRowHeights(true);
  names_->setTextElideMode(Qt::ElideMiddle);
  names_->setMinimumHeight(kListHeight);
  names_->header()->setStretchLastSection(false);
  names_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int column = 1; column < names_->columnCount(); ++column) {
    names_->header()->setSectionResizeMode(column, QHeaderView::Fixed);
    names_->header()->resizeSection(column, kNumberWidth);
  }
  make_column(this, {help, {names_, 1}, summary_});
}

void PatternPanel::preview(const std::string& pattern, bool is_snake) {
  job_.start<io::PatternPreview>(
      [folder = folder_.toStdString(), pattern, is_snake](const Progress&) {
        return preview_of(folder, pattern, is_snake);
      },
      [this](const io::PatternPreview& preview) { fill(preview); });
}

void PatternPanel::fill(const io::PatternPreview& preview) {
  names_->clear();
  QList<QTreeWidgetItem*> items;
  bool has_row = false;
  bool has_index = false;
  bool has_view = false;
  for (const io::NamePreview& name : preview.names) {
    items << make_item(name, palette());
    has_row |= name.row || name.column;
    has_index |= name.index.has_value();
    has_view |= name.view.has_value() || !name.is_match;
  }
  names_->addTopLevelItems(items);
  names_->setColumnHidden(1, !has_row);
  names_->setColumnHidden(2, !has_row);
  names_->setColumnHidden(3, !has_index);
  names_->setColumnHidden(kViewColumn, !has_view);
  summary_->setText(summary_of(preview));
  const bool is_wrong = !preview.problem.empty() || !preview.warnings.empty();
  summary_->setPalette(is_wrong ? theme::text_palette(theme::warning_text(palette())) : palette());
}

/// Asks how to read a file where the automatic choice is wrong, with a row for each option that its
/// reader supports. Where names of files count it shows what a pattern makes of them.
class ConventionsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `given` are the options set by now.
  ConventionsDialog(const QString& path, const std::vector<ParameterDescription>& options,
                    const ParameterSet& given, QWidget* parent);

  /// The options that are not automatic.
  [[nodiscard]] ParameterSet given() const;

 private:
  [[nodiscard]] PatternPanel* makePatternPanel(const QString& path);

  ParameterForm* form_;
};

constexpr int kConventionsWidth = 460;
constexpr int kWidthWithNames = 620;

bool has_option(const std::vector<ParameterDescription>& options, const char* key) {
  return std::ranges::find(options, key, &ParameterDescription::key) != options.end();
}

ConventionsDialog::ConventionsDialog(const QString& path,
                                     const std::vector<ParameterDescription>& options,
                                     const ParameterSet& given, QWidget* parent)
    : QDialog(parent), form_(new ParameterForm(this)) {
  setObjectName("conventions");
  setWindowTitle(tr("Conventions"));
  auto* file = new ElidedLabel(this, Qt::ElideMiddle);
  file->setFullText(path);
  auto* note = new QLabel(tr("The file will be read again and your choice remembered. Results of "
                             "this light field will be removed from the list."),
                          this);
  note->setWordWrap(true);
  form_->setParameters(options);
  form_->setValues(given);
  auto* buttons = make_answers(this, "conventions.apply", tr("Read again"));
  QPushButton* reset = buttons->addButton(QDialogButtonBox::RestoreDefaults);
  reset->setText(tr("All automatic"));
  reset->setObjectName("conventions.reset");
  auto* layout = make_column(this, {file, form_}, {.margins = kStyleMargins});
  const bool has_names = has_option(options, "pattern");
  if (has_names) {
    layout->addWidget(makePatternPanel(path), 1);
  } else {
    layout->addStretch(1);
  }
  layout->addWidget(note);
  layout->addWidget(buttons);
  connect(reset, &QPushButton::clicked, form_, &ParameterForm::resetToDefaults);
  layout->activate();
  const int width = has_names ? kWidthWithNames : kConventionsWidth;
  resize(width, layout->heightForWidth(width));
}

PatternPanel* ConventionsDialog::makePatternPanel(const QString& path) {
  auto* panel = new PatternPanel(path, this);
  const auto show = [this, panel] {
    const auto options = io::open_schema().parse(form_->modifiedValues());
    panel->preview(options.pattern, options.snake);
  };
  connect(form_, &ParameterForm::valuesChanged, panel, show);
  show();
  return panel;
}

ParameterSet ConventionsDialog::given() const {
  return form_->modifiedValues();
}

/// What the info panel says about a scene.
struct SceneInfo {
  QString title;
  std::vector<InfoRow> rows;
  std::vector<InfoWarning> warnings;
};

struct InfoPanelText {
  Q_DECLARE_TR_FUNCTIONS(episcope::InfoPanel)
};

QString type_text(const LightField& light_field) {
  const QString color =
      light_field.channels() == 3 ? InfoPanelText::tr("RGB") : InfoPanelText::tr("grey");
  switch (light_field.sample_type()) {
    case SampleType::UInt8:
      return color + InfoPanelText::tr(", 8 bit");
    case SampleType::UInt16:
      return color + InfoPanelText::tr(", 16 bit");
    case SampleType::Float32:
      return color + InfoPanelText::tr(", float");
  }
  return color;
}

QString sample_text(const LightField& light_field) {
  const QString type = type_text(light_field);
  return light_field.is_on_disk() ? type + InfoPanelText::tr(", on disk") : type;
}

QString coverage(const ViewStack<float>& maps, GridShape grid) {
  return maps.grid() == grid
             ? InfoPanelText::tr("all views")
             : InfoPanelText::tr("%1 of %2 views").arg(maps.grid().count()).arg(grid.count());
}

QString truth_text(const GroundTruth& truth, GridShape grid) {
  QStringList parts;
  if (truth.has_disparity()) {
    parts << InfoPanelText::tr("disparity (%1)").arg(coverage(truth.field.disparity, grid));
  }
  if (truth.has_layers()) parts << InfoPanelText::tr("two layers");
  if (truth.estimated) parts << QString::fromStdString(estimated_text(*truth.estimated));
  if (!truth.labels.empty()) parts << InfoPanelText::tr("labels");
  if (!truth.regions.empty()) {
    const int regions = static_cast<int>(truth.regions.size());
    parts << (regions == 1 ? InfoPanelText::tr("1 region mask")
                           : InfoPanelText::tr("%1 region masks").arg(regions));
  }
  if (truth.high_res) parts << InfoPanelText::tr("also at ten times the resolution");
  return parts.isEmpty() ? InfoPanelText::tr("none") : parts.join(", ");
}

// Four digits, and no exponent where whole numbers say as much.
QString measure(double value) {
  return std::abs(value) >= 1000 ? number_text(value, 0)
                                 : with_minus(QString::number(value, 'g', 4));
}

QString camera_text(const CameraGrid& camera) {
  if (!camera.is_known()) return InfoPanelText::tr("unknown");
  QString line = InfoPanelText::tr("B·f %1, shift %2 px")
                     .arg(measure(camera.baseline * camera.focal_length), measure(camera.shift));
  if (camera.cam_distance) line += InfoPanelText::tr(", Z₀ %1").arg(measure(*camera.cam_distance));
  return line;
}

QString megabytes(std::size_t bytes) {
  const double count = static_cast<double>(bytes) / 1e6;
  return QString::number(count, 'f', count < 10 ? 1 : 0);
}

QString by_whom(const std::string& finding, bool was_chosen) {
  const QString shown = finding_words(finding);
  return was_chosen ? InfoPanelText::tr("%1 (set by you)").arg(shown) : shown;
}

// "81 views; not used: 2 results (a.h5)".
QString files_words(const ConventionReport& convention) {
  return QString::fromStdString(files_text(convention, [](const std::string& text) {
    const QString words = text == kNotUsed ? InfoPanelText::tr("not used: ") : schema_text(text);
    return words.toStdString();
  }));
}

// Names of an image grid that were given; empty if they were found.
QString names_text(const Reading& reading) {
  const ParameterValue* pattern = reading.find("pattern");
  const bool is_snake = reading.find("snake") != nullptr;
  if (!pattern && !is_snake) return {};
  QString names =
      pattern ? QString::fromStdString(to_text(*pattern)) : InfoPanelText::tr("automatic");
  if (is_snake) names += InfoPanelText::tr(", snake");
  return InfoPanelText::tr("%1 (set by you)").arg(names);
}

// `conventions` opens the options that a warning names. Has a short line where the engine knows
// one.
InfoWarning in_window(const std::string& warning, QAction* conventions) {
  const QString text = finding_words(warning);
  const QString named = with_conventions(text);
  return {named, finding_brief(warning), named == text ? nullptr : conventions, is_note(warning)};
}

// The GPU that methods compute on.
QString gpu_text(const CudaDevice& device) {
  const auto gibibytes = [](std::size_t bytes) {
    return QString::number(static_cast<double>(bytes) / (1 << 30), 'f', 1);
  };
  if (!device.is_available) return InfoPanelText::tr("none");
  return InfoPanelText::tr("%1, %2 of %3 GiB free")
      .arg(QString::fromStdString(device.name), gibibytes(device.free_memory),
           gibibytes(device.memory));
}

void add_conventions(SceneInfo& info, const CameraGrid& camera,
                     const ConventionReport& convention) {
  info.rows.push_back({InfoPanelText::tr("Order"),
                       by_whom(convention.order, convention.order_was_chosen),
                       finding_words(convention.order_check), "order"});
  info.rows.push_back(
      {InfoPanelText::tr("Sign"),
       convention.sign.empty() ? InfoPanelText::tr("not known") : InfoPanelText::tr("checked"),
       finding_words(convention.sign_check), "sign"});
  info.rows.push_back(
      {InfoPanelText::tr("Camera"), camera_text(camera),
       camera.is_known() ? QString() : InfoPanelText::tr("There is disparity, but no depth."),
       "camera"});
  if (!convention.units.empty()) {
    info.rows.push_back({InfoPanelText::tr("Depth"),
                         by_whom(convention.units, convention.units_were_chosen),
                         finding_words(convention.units_check), "units"});
  }
  info.rows.push_back(
      {InfoPanelText::tr("Format"), finding_words(convention.format), {}, "format"});
}

// Whether a warning says it, which no row repeats.
bool is_told(const ConventionReport& convention, std::string_view codes) {
  return std::ranges::any_of(convention.warnings, [codes](const std::string& warning) {
    const auto finding = finding_of(warning);
    return finding && finding->code.starts_with(codes);
  });
}

// Views, size, samples and what is known of them.
void add_samples(SceneInfo& info, const Scene& scene) {
  const LightField& light_field = *scene.light_field;
  const GridShape grid = light_field.grid();
  const ConventionReport& convention = scene.convention;
  info.rows.push_back(
      {InfoPanelText::tr("Views"), InfoPanelText::tr("%1×%2").arg(grid.v).arg(grid.u), {}});
  info.rows.push_back({InfoPanelText::tr("Size"),
                       InfoPanelText::tr("%1×%2 px, %3 MB")
                           .arg(light_field.width())
                           .arg(light_field.height())
                           .arg(megabytes(light_field.byte_size())),
                       {}});
  info.rows.push_back({.key = InfoPanelText::tr("Samples"),
                       .value = sample_text(light_field),
                       .id = "samples",
                       .tip = finding_words(samples_text(scene))});
  if (!light_field.valid().empty() && !is_told(convention, "valid.")) {
    info.rows.push_back({InfoPanelText::tr("Valid"),
                         InfoPanelText::tr("%1 %").arg(number_text(valid_percent(light_field), 1)),
                         InfoPanelText::tr("The others are dark or empty and do not count.")});
  }
  if (!convention.gain.empty() && !is_told(convention, "brightness.")) {
    info.rows.push_back(
        {InfoPanelText::tr("Brightness"), finding_words(convention.gain), {}, "gain"});
  }
}

// Disparities, focus and ground truth.
void add_disparities(SceneInfo& info, const Scene& scene) {
  if (const Interval range = known_disparity_range(scene); range.length() > 0) {
    info.rows.push_back(
        {InfoPanelText::tr("Disparity"),
         InfoPanelText::tr("%1 … %2 px").arg(number_text(range.min, 2), number_text(range.max, 2)),
         {}});
  }
  if (const double focus = scene.convention.focus_px; focus != 0) {
    info.rows.push_back({InfoPanelText::tr("Focus"),
                         InfoPanelText::tr("%1 px applied").arg(number_text(focus, 2)),
                         InfoPanelText::tr("All views but the center one are interpolated.")});
  }
  info.rows.push_back(
      {InfoPanelText::tr("Ground truth"), truth_text(*scene.truth, scene.light_field->grid()), {}});
}

// Files, those that belong to the light field among them.
void add_files(SceneInfo& info, const Scene& scene) {
  const LightFieldInfo& read = scene.light_field->info();
  if (const QString names = names_text(read.reading); !names.isEmpty()) {
    info.rows.push_back({InfoPanelText::tr("Names"), names, {}, "names"});
  }
  for (const Companion& companion : scene.companions) {
    info.rows.push_back(
        {schema_text(companion_name(companion.kind)), QString::fromStdString(companion.shape), {}});
  }
  if (const QString files = files_words(scene.convention); !files.isEmpty()) {
    info.rows.push_back({InfoPanelText::tr("Files"), files, {}, "files"});
  }
  info.rows.push_back(
      {InfoPanelText::tr("Source"), QString::fromStdString(read.source), {}, "source"});
}

// `gpu`: device that methods compute on; none while unknown. `conventions`: opens the dialog.
SceneInfo describe(const Scene& scene, const std::optional<CudaDevice>& gpu, QAction* conventions) {
  const LightFieldInfo& read = scene.light_field->info();
  SceneInfo info;
  info.title = QString::fromStdString(read.name);
  add_samples(info, scene);
  add_disparities(info, scene);
  add_conventions(info, read.camera, scene.convention);
  add_files(info, scene);
  info.rows.push_back({InfoPanelText::tr("GPU"),
                       gpu ? gpu_text(*gpu) : InfoPanelText::tr("searching …"),
                       gpu ? schema_text(gpu->why_not) : QString(), "gpu"});
  for (const std::string& warning : scene.convention.warnings) {
    info.warnings.push_back(in_window(warning, conventions));
  }
  return info;
}

// Options known to a reader of the input; for an input that nobody reads, all but the focus plane.
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
  conventions_ =
      bench.commands.add({.id = "file.conventions",
                          .menu = Menu::File,
                          .text = tr("Conventions…"),
                          .tip = tr("Overrides the detected order of views, units or file names"),
                          .keys = {tr("Ctrl+Shift+R")},
                          .run = [this] { askForConventions(); },
                          .section = section::kReading,
                          .enabled = [this] { return !bench_.opener.reopenable().isEmpty(); }});
  panel_->setConventionsAction(conventions_);
  reverse_ = bench.commands.add(
      {.id = "file.reverse_sign",
       .menu = Menu::File,
       .text = tr("Reverse near and far"),
       .tip = tr("Reverses the order of views along both axes, which swaps near and far"),
       .run = [this] { reverseSign(); },
       .section = section::kReading,
       .enabled = [this] { return canReverseSign(); }});
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &InfoController::show);
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
  // The facts of another light field do not stand beside the one that is coming.
  if (bench_.viewer_area.isPreviewing()) {
    panel_->setInfo(tr("Opening …"), {}, {});
  } else if (const auto& scene = bench_.session.scene()) {
    SceneInfo info = describe(*scene, gpu_, conventions_);
    const auto sign = std::ranges::find(info.rows, QString("sign"), &InfoRow::id);
    if (sign != info.rows.end() && canReverseSign()) {
      sign->action = reverse_;
      sign->needs_action = scene->convention.sign.empty();
    }
    panel_->setInfo(info.title, info.rows, info.warnings);
  } else {
    panel_->setInfo(tr("Nothing is open"), {}, {});
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

#include "info_controller.moc"
#include "moc_info_controller.cpp"
