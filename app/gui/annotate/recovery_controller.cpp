// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/recovery_controller.h"

#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "widgets/controls/message_bar.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace episcope {
namespace {

QString name_of(const RecoverableJournal& journal) {
  return QString::fromStdString(journal.owner.name);
}

/// What a worker found in a journal, or why it found nothing.
struct Found {
  std::unique_ptr<RecoveredAnnotation> annotation;
  std::uint64_t sample_hash = 0;  ///< Of the light field that is open.
  QString failure;
};

}  // namespace

RecoveryController::RecoveryController(const Workbench& bench)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      document_(bench.document),
      bar_(new MessageBar(&bench.frame)),
      job_(this) {
  bar_->setObjectName("recoveryBar");
  bench.frame.addFloating(bar_);
  connect(&bench.frame, &Frame::settled, this, &RecoveryController::look);
  connect(&document_, &DocumentController::replaced, this, [this] {
    if (!awaited_ || !isOpen(awaited_->owner)) return;
    read(*std::exchange(awaited_, std::nullopt));
  });
}

bool RecoveryController::isOpen(const JournalOwner& owner) const {
  return session_.scene() && session_.input() == owner.source &&
         session_.scene()->convention.focus_px == owner.focus_px;
}

void RecoveryController::look() {
  using Journals = std::vector<RecoverableJournal>;
  job_.start<Journals>(
      [folder = document_.journalFolder()](const Progress&) {
        return folder.empty() ? Journals() : recoverable_journals(folder);
      },
      [this](Journals journals) {
        left_ = std::move(journals);
        std::ranges::reverse(left_);
        offerNext();
      });
}

void RecoveryController::offerNext() {
  if (left_.empty()) return;
  const RecoverableJournal journal = left_.back();
  left_.pop_back();
  bar_->showMessage(Severity::Warning,
                    tr("Episcope ended unexpectedly while “%1” was being annotated (%2). Your work "
                       "can be recovered.")
                        .arg(name_of(journal), short_text(journal.last_change)),
                    {tr("Recover"), [this, journal] { recover(journal); }},
                    {tr("Discard"), [this, journal] { discard(journal); }});
}

void RecoveryController::discard(const RecoverableJournal& journal) {
  discard_journal(journal.path);
  offerNext();
}

void RecoveryController::recover(const RecoverableJournal& journal) {
  const auto go_on = [this, journal] {
    if (document_.document() && isOpen(journal.owner)) {
      read(journal);
      return;
    }
    awaited_ = journal;
    open(journal.owner);
  };
  // What was painted meanwhile on the same light field is replaced.
  isOpen(journal.owner) ? bench_.guards.leave(Leaving::Reading, go_on) : go_on();
}

void RecoveryController::open(const JournalOwner& owner) {
  std::function<void()> then;
  if (owner.focus_px != 0) {
    then = [this, focus_px = owner.focus_px] { bench_.opener.reopenAt(focus_px, nullptr); };
  }
  bench_.opener.open(QString::fromStdString(owner.source), std::move(then));
}

void RecoveryController::read(const RecoverableJournal& journal) {
  job_.start<std::shared_ptr<Found>>(
      [journal, light_field = session_.light_field()](const Progress&) {
        auto found = std::make_shared<Found>();
        try {
          found->annotation = std::make_unique<RecoveredAnnotation>(read_journal(journal.path));
          found->sample_hash = light_field->sample_hash();
        } catch (const IoError& error) {
          found->failure = QString::fromUtf8(error.what());
        }
        return found;
      },
      [this, journal](const std::shared_ptr<Found>& found) {
        if (!found->failure.isEmpty()) {
          refuse(found->failure);
        } else {
          takeOver(journal, std::move(*found->annotation), found->sample_hash);
        }
      });
}

void RecoveryController::takeOver(const RecoverableJournal& journal, RecoveredAnnotation found,
                                  std::uint64_t sample_hash) {
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field || !isOpen(journal.owner)) return;
  const ScribbleLayer& layer = found.document.scribbles();
  const bool fits = layer.grid() == light_field->grid() &&
                    layer.height() == light_field->height() &&
                    layer.width() == light_field->width();
  if (!fits || (found.owner.sample_hash != 0 && found.owner.sample_hash != sample_hash)) {
    refuse(tr("“%1” is no longer the light field that was annotated. Your work is kept in %2.")
               .arg(name_of(journal), QString::fromStdString(journal.path.string())));
    return;
  }
  const bool is_kept =
      document_.replace(std::move(found.document), document_.isWhole(), found.owner.file);
  if (is_kept) discard_journal(journal.path);  // else it is the only one
  bench_.frame.showTab("annotate");
  bench_.messages.success(tr("Recovered the annotation of “%1”.").arg(name_of(journal)));
  offerNext();
}

void RecoveryController::refuse(const QString& sentence) {
  bar_->showMessage(Severity::Error, sentence);
}

}  // namespace episcope

#include "moc_recovery_controller.cpp"
