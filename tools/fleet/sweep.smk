# A sweep replays all settings over the training runs, and the best one by the criterion also over the held-out runs.
import json

import sweep
import sweep_page
import sweep_table

SWEEP = sweep.DEFAULTS | VARIANTS[BASELINE] | config["sweep"]
try:
    sweep.check(SWEEP, list({job.path: job.tags for job in corpus.jobs_of(RUNS, SWEEP)}.values()))
    SWEPT = sweep.variants_of(SWEEP)
except sweep.Mistake as mistake:
    sys.exit(f"fleet: sweep: {mistake}")
if set(SWEPT) & set(VARIANTS):
    sys.exit(f"fleet: sweep: {', '.join(set(SWEPT) & set(VARIANTS))}: is the name of a variant too")
JOBS |= {name: {job.key: job for job in corpus.jobs_of(RUNS, variant)} for name, variant in SWEPT.items()}
CRITERION, HOLD_OUT = SWEEP["criterion"], SWEEP["hold_out"]


def chosen():
    with open(checkpoints.choose.get().output.json, encoding="utf-8") as file:
        return json.load(file)["best"]


rule compare_setting:
    input:
        after=lambda wildcards: reports_of(wildcards.setting, lambda job: HOLD_OUT not in job.tags),
        before=reports_of(BASELINE, lambda job: HOLD_OUT not in job.tags),
    output:
        json=OUT + "/sweep/settings/{setting}.json",
    params:
        azimuth=VARIANTS[BASELINE]["azimuth"],
        costs=config.get("costs", True),
    run:
        compare(params.azimuth, input, output.json)


checkpoint choose:
    input:
        [f"{OUT}/sweep/settings/{setting}.json" for setting in SWEPT],
    output:
        json=OUT + "/sweep/chosen.json",
    params:
        criterion=CRITERION,
        settings=list(SWEPT),
    run:
        comparisons = {setting: json.load(open(file, encoding="utf-8")) for setting, file in zip(params.settings, input)}
        try:
            choice = sweep_table.chosen(comparisons, params.criterion)
        except sweep.Mistake as mistake:
            sys.exit(f"fleet: sweep: {mistake}")
        with open(output.json, "w", encoding="utf-8") as file:
            json.dump(choice, file, indent=2)


rule compare_chosen:
    input:
        choice=OUT + "/sweep/chosen.json",
        after=lambda wildcards: reports_of(chosen(), lambda job: HOLD_OUT in job.tags),
        before=reports_of(BASELINE, lambda job: HOLD_OUT in job.tags),
    output:
        json=OUT + "/sweep/held_out.json",
    params:
        azimuth=VARIANTS[BASELINE]["azimuth"],
        costs=config.get("costs", True),
    run:
        compare(params.azimuth, input, output.json)


rule sweep:
    input:
        choice=OUT + "/sweep/chosen.json",
        held_out=OUT + "/sweep/held_out.json",
    output:
        json=OUT + "/sweep/sweep.json",
        text=OUT + "/sweep/sweep.txt",
        html=OUT + "/sweep/sweep.html",
    params:
        hold_out=HOLD_OUT,
        sets={name: variant["set"][-len(SWEEP["settings"]):] for name, variant in SWEPT.items()},     # the swept settings come last
    run:
        choice, held_out = (json.load(open(file, encoding="utf-8")) for file in (input.choice, input.held_out))
        for setting in choice["settings"]:
            setting["set"] = params.sets[setting["settings"]]
        table = sweep_table.tested(choice, held_out, params.hold_out)
        for file, text in ((output.json, json.dumps(table, indent=2)), (output.text, sweep_table.text(table)), (output.html, sweep_page.page(table))):
            with open(file, "w", encoding="utf-8") as opened:
                opened.write(text)
