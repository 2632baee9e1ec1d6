# Flights of a sweep (monarch sweep) side by side: a folder runs/<name> for each case file cases/<name>.yaml, then a table.
NAMES = glob_wildcards("cases/{name}.yaml").name


rule table:
    input:
        expand("runs/{name}/summary.json", name=NAMES),
    output:
        "table.csv",
    shell:
        "{config[monarch]} sweep --table {output} {input}"


# A flight that fails has a summary too and is a row of the table; one that was stopped is flown again.
rule fly:
    input:
        "cases/{name}.yaml",
    output:
        "runs/{name}/summary.json",
    log:
        "logs/{name}.log",
    params:
        options=config["options"] or "",  # of monarch fly; other ones: flown again
    shell:
        "rm -rf runs/{wildcards.name}; code=0; "
        "{config[monarch]} fly case:={input} out:=runs/{wildcards.name} in_process:=true rviz:=false report:=false"
        " {params.options} > {log} 2>&1 || code=$?; "
        "[ $code -ne 130 ] && [ -f {output} ] || {{ tail -n 3 {log} >&2; exit 1; }}"
